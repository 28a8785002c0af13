// When the cross product of a patch's tangents is a normal, whatever rounding did to it.
#pragma once

#include <limits>

namespace rondure {

// Rounding turns the cross product by about (error of a) |b| / |n| + |a| (error of b) / |n|. The tangents are
// sums of control points, so their errors are relative to those, whatever the unit of length. `magnitude`:
// the size of the coordinates. A cross product of more than this times the sum of the tangents' lengths is
// good to 2e-13.
inline double normal_noise(int degree, double magnitude) {
  constexpr double accurate = 2e-13;
  return 8.0 / accurate * std::numeric_limits<double>::epsilon() * degree * magnitude;
}

// The squares of lengths between these are neither subnormal nor infinite. That zero is not among them
// matters where the tangents vanish.
inline constexpr double shortest_normal = 1e-145, longest_normal = 1e150;

// `tangents`: the sum of their lengths. `length`: of their cross product.
inline bool is_regular_normal(double noise, double tangents, double length) {
  return noise * tangents <= length && length > shortest_normal && length < longest_normal;
}

}  // namespace rondure
