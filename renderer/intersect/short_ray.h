// Rays whose direction is so short that t, counted in it, nears the end of the doubles: met in longer steps.
#pragma once

#include <cmath>

#include "renderer/intersect/local_ray.h"

namespace rondure {

// Beside denormal numbers, and far beyond all directions that mean a length.
inline constexpr double short_direction = 0x1p-900;
// A power of two, so that nothing rounds.
inline constexpr double longer_step = 0x1p150;

inline bool is_short(const Ray& ray) {
  const double size = largest(ray.direction);
  return size > 0.0 && size < short_direction;
}

inline Ray lengthened(Ray ray) {
  ray.direction *= longer_step;
  ray.t_min /= longer_step, ray.t_max /= longer_step;
  return ray;
}

// Whether the short ray gets there: its t must be a number.
inline bool can_shorten(const Hit& hit) { return hit && std::isfinite(hit.t * longer_step); }

inline Hit shortened(Hit hit) {
  hit.t *= longer_step, hit.t_error *= longer_step;
  return hit;
}

}  // namespace rondure
