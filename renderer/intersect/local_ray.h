// A ray seen from one surface's frame, as the meet of two planes.
//
// The ray's origin may be millions of radii away, where o + t d costs most of its digits. So the ray is first
// slid to its point nearest to the frame's zero, in twice the working precision: what is left, `base`, is as
// exact as the frame itself, and only the final sum t = slide + s rounds at the size of t.
//
// A query meets many surfaces with one direction, and not every surface asks for the planes: the parts are
// made one by one, `make_local_ray` makes them all.
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
  double scale = 1.0;    // t of the ray = (slide + s) * scale, a power of two
  double length2 = 1.0;  // direction . direction
  double inverse_scale = 1.0, inverse_length2 = 1.0;
  // Unit normals of two planes that meet in the ray, and minus their distances: plane . (x, 1) = 0 on the
  // ray.
  dvec4 plane[2];
};

// |x| as the largest component: cheap, and within sqrt(3) of the length. Blind to NaN, as std::fmax is, which
// is a function call.
inline double largest(const dvec3& x) {
  return std::max(std::max(std::max(0.0, std::fabs(x.x)), std::fabs(x.y)), std::fabs(x.z));
}

// No difference is NaN, infinity less itself being one.
inline bool is_finite(const dvec3& x) { return (x.x - x.x) + (x.y - x.y) + (x.z - x.z) == 0.0; }

// 2^exponent, from -1022 to 1023.
inline double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

// Sets direction, scale, length2 and their inverses. False when the direction is not finite or zero: such a
// ray meets nothing.
inline bool set_direction(const dvec3& direction, LocalRay& ray) {
  const double size = largest(direction);
  if (!(size > 0.0) || !is_finite(direction)) return false;
  const int biased = static_cast<int>(std::bit_cast<std::uint64_t>(size) >> 52);
  if (biased > 23 && biased < 2023) {
    ray.scale = power_of_two(1023 - biased), ray.inverse_scale = power_of_two(biased - 1023);
    ray.direction = direction * ray.scale;
  } else {
    // Two steps, so that neither factor overflows for denormal directions.
    const int exponent = std::ilogb(size);
    const double half = power_of_two(-(exponent / 2)), rest = power_of_two(-(exponent - exponent / 2));
    ray.direction = direction * half * rest;
    ray.scale = half * rest, ray.inverse_scale = 1.0 / ray.scale;
  }
  ray.length2 = glm::dot(ray.direction, ray.direction);
  ray.inverse_length2 = 1.0 / ray.length2;
  return true;
}

// Sets base and slide, for a ray whose direction is set and whose origin is finite. False when the ray is too
// far away to tell.
inline bool set_base(const dvec3& origin, const dvec3& frame, LocalRay& ray) {
  const dvec3& d = ray.direction;
  TwoFold offset[3];
  dvec3 towards;
  for (int k = 0; k < 3; ++k) {
    offset[k] = two_sum(frame[k], -origin[k]);
    towards[k] = offset[k].high;
  }
  ray.slide = glm::dot(towards, d) / ray.length2;
  if (!(std::fabs(ray.slide) < 0x1p990)) return false;
  const Halves slide = halves(ray.slide);
  for (int k = 0; k < 3; ++k) {
    const TwoFold step = two_product(slide, halves(d[k]));
    const TwoFold sum = two_sum(step.high, -offset[k].high);
    ray.base[k] = sum.high + (sum.low + (step.low - offset[k].low));
  }
  return true;
}

// Sets the normals of both planes, which depend on the direction alone.
inline void set_normals(LocalRay& ray) {
  // Any frame across d does; this one has no branch that could send nearly equal rays to distant frames but
  // for the sign of d.z (Duff et al. 2017).
  const dvec3 unit = ray.direction * (1.0 / std::sqrt(ray.length2));
  const double sign = std::copysign(1.0, unit.z), a = -1.0 / (sign + unit.z), b = unit.x * unit.y * a;
  ray.plane[0] = dvec4(1.0 + sign * unit.x * unit.x * a, sign * b, -sign * unit.x, 0.0);
  ray.plane[1] = dvec4(b, sign + unit.y * unit.y * a, -unit.y, 0.0);
}

// Sets the distances of both planes, from their normals and the base.
inline void set_distances(LocalRay& ray) {
  for (dvec4& plane : ray.plane) plane.w = -glm::dot(dvec3(plane), ray.base);
}

// All of it. False when the ray is not finite or has no direction: such a ray meets nothing.
inline bool make_local_ray(const dvec3& origin, const dvec3& direction, const dvec3& frame, LocalRay& out) {
  if (!is_finite(origin) || !set_direction(direction, out) || !set_base(origin, frame, out)) return false;
  set_normals(out);
  set_distances(out);
  return true;
}

}  // namespace rondure
