// A ray seen from one surface's frame, as the meet of two planes.
//
// The ray's origin may be millions of radii away, where o + t d costs most of its digits. So the ray is first
// slid to its point nearest to the frame's zero, in twice the working precision: what is left, `base`, is as
// exact as the frame itself, and only the final sum t = slide + s rounds at the size of t.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "renderer/intersect/ray.h"
#include "renderer/intersect/two_fold.h"

namespace rondure {

struct LocalRay {
  dvec3 base{0.0};       // point of the ray nearest to the frame's zero, to within an ulp of |base|
  dvec3 direction{0.0};  // the ray's direction times a power of two: largest component in [1, 2)
  double slide = 0.0;    // t (in units of `direction`) of `base`
  double scale = 1.0;    // t of the ray = (slide + s) * scale
  double length2 = 1.0;  // direction . direction
  // Unit normals of two planes that meet in the ray, and minus their distances: plane . (x, 1) = 0 on the
  // ray.
  dvec4 plane[2];
};

// |x| as the largest component: cheap, and within sqrt(3) of the length. Blind to NaN, as std::fmax is, which
// is a function call.
inline double largest(const dvec3& x) {
  return std::max(std::max(std::max(0.0, std::fabs(x.x)), std::fabs(x.y)), std::fabs(x.z));
}

inline bool is_finite(const dvec3& x) {
  return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
}

// 2^exponent, from -1022 to 1023.
inline double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

// False when the ray is not finite or has no direction: such a ray meets nothing.
inline bool make_local_ray(const dvec3& origin, const dvec3& direction, const dvec3& frame, LocalRay& out) {
  const double size = largest(direction);
  if (!(size > 0.0) || !is_finite(direction) || !is_finite(origin)) return false;
  const int exponent = std::ilogb(size);
  // Two steps, so that neither factor overflows for denormal directions.
  const double half = power_of_two(-(exponent / 2)), rest = power_of_two(-(exponent - exponent / 2));
  out.direction = direction * half * rest;
  out.scale = half * rest;
  const dvec3& d = out.direction;
  out.length2 = glm::dot(d, d);

  TwoFold offset[3];
  dvec3 towards;
  for (int k = 0; k < 3; ++k) {
    offset[k] = two_sum(frame[k], -origin[k]);
    towards[k] = offset[k].high;
  }
  out.slide = glm::dot(towards, d) / out.length2;
  if (!std::isfinite(out.slide)) return false;
  for (int k = 0; k < 3; ++k) {
    const TwoFold step = two_product(out.slide, d[k]);
    const TwoFold sum = two_sum(step.high, -offset[k].high);
    out.base[k] = sum.high + (sum.low + (step.low - offset[k].low));
  }

  // Any frame across d does; this one has no branch that could send nearly equal rays to distant frames but
  // for the sign of d.z (Duff et al. 2017).
  const dvec3 unit = d / std::sqrt(out.length2);
  const double sign = std::copysign(1.0, unit.z), a = -1.0 / (sign + unit.z), b = unit.x * unit.y * a;
  const dvec3 n0(1.0 + sign * unit.x * unit.x * a, sign * b, -sign * unit.x);
  const dvec3 n1(b, sign + unit.y * unit.y * a, -unit.y);
  out.plane[0] = dvec4(n0, -glm::dot(n0, out.base));
  out.plane[1] = dvec4(n1, -glm::dot(n1, out.base));
  return true;
}

}  // namespace rondure
