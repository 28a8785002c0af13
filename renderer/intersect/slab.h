// Whether a ray's line meets a box.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/bezier/box.h"
#include "renderer/bezier/quotient.h"
#include "renderer/intersect/local_ray.h"

namespace rondure {

// 1 / direction: infinite along the axes that a ray does not move along, as `meets_box` takes it.
inline dvec3 inverse_of(const dvec3& direction) {
  return {quotient(1.0, direction.x), quotient(1.0, direction.y), quotient(1.0, direction.z)};
}

// The part of the ray's line within the box, in its own steps: none where `enter` is above `leave`.
struct Span {
  double enter, leave;
};

// `inverse_direction`: of the ray's. In double, with room for its own rounding and for roots that lie
// beside their leaf by rounding.
inline Span span_in_box(const LocalRay& ray, const dvec3& inverse_direction, const Box& box) {
  double enter = -INFINITY, leave = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const double room =
        1e-12 * (std::fabs(ray.base[k]) + std::max(std::fabs(box.low[k]), std::fabs(box.high[k])) +
                 (box.high[k] - box.low[k]));
    double a = (box.low[k] - room - ray.base[k]) * inverse_direction[k];
    double b = (box.high[k] + room - ray.base[k]) * inverse_direction[k];
    if (a > b) std::swap(a, b);
    // A NaN, from 0 times infinity, is passed over.
    enter = a > enter ? a : enter;
    leave = b < leave ? b : leave;
  }
  return {enter, leave};
}

inline bool meets_box(const LocalRay& ray, const dvec3& inverse_direction, const Box& box) {
  const Span span = span_in_box(ray, inverse_direction, box);
  return span.enter <= span.leave;
}

}  // namespace rondure
