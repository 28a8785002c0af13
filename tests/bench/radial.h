// Inverse spherical models met in one unknown and by Newton's method, side by side.
#pragma once

namespace rondure::bench {

// Prints a table: nanoseconds a ray, and how many times faster the radial solver is, on coherent and
// incoherent rays, the median of `rounds` rounds in each of which both take their turn.
void print_radial(int rounds);

}  // namespace rondure::bench
