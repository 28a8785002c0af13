// A vector as a unit normal, if it has a direction.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "renderer/api/patch.h"

namespace rondure {

// None for zero, NaN and infinite vectors. Scaled first, so that no square underflows.
inline std::optional<dvec3> direction_of(const dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0.0) || !std::isfinite(largest) || std::isnan(v.x + v.y + v.z)) return {};
  return glm::normalize(v / largest);
}

// Whether |a x b| is so small beside |a| |b| that tangents a and b count as parallel.
inline bool nearly_parallel(const dvec3& a, const dvec3& b, double threshold) {
  return !(glm::length(glm::cross(a, b)) > threshold * glm::length(a) * glm::length(b));
}

}  // namespace rondure
