#include "renderer/intersect/instructions.h"

namespace rondure {

bool has([[maybe_unused]] Instructions set) {
#ifdef __x86_64__
  if (set == Instructions::avx2) return __builtin_cpu_supports("avx2") != 0;
#endif
  return set == Instructions::baseline;
}

Instructions best_instructions() {
  static const Instructions best = has(Instructions::avx2) ? Instructions::avx2 : Instructions::baseline;
  return best;
}

}  // namespace rondure
