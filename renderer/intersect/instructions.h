// Instruction sets that Newton's method and the making of leaves are compiled for. The results are the same
// bits on all.
#pragma once

namespace rondure {

enum class Instructions { baseline, avx2 };

// Whether this machine has the set.
bool has(Instructions set);

// The best that it has.
Instructions best_instructions();

}  // namespace rondure
