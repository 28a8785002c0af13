// Newton's method where no closed form is known, and on the spheres' patches too.
#pragma once

namespace rondure::bench {

// Prints a table: rays as ratios to Embree's own sphere in the same rounds, leaves, memory, and what a ray
// costs in leaf tests, steps and searches.
void print_newton(int rounds);

}  // namespace rondure::bench
