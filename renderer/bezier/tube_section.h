// The round cross-section that all tubes have.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/api/patch.h"

namespace rondure::detail {

// A third of the unit circle: control points (x, y) of weights 1, 1/2, 1. The middle one lies at distance 2.
struct Third {
  dvec2 point[3];
  double weight[3] = {1.0, 0.5, 1.0};
};

inline std::array<Third, 3> unit_circle() {
  constexpr double h = 0.86602540378443864676;
  const dvec2 corner[3] = {{1.0, 0.0}, {-0.5, h}, {-0.5, -h}};
  std::array<Third, 3> thirds;
  for (std::size_t k = 0; k < 3; ++k) {
    const dvec2 from = corner[k], to = corner[(k + 1) % 3];
    thirds[k].point[0] = from;
    thirds[k].point[1] = 2.0 * (from + to);  // the corners' sum has length 1
    thirds[k].point[2] = to;
  }
  return thirds;
}

// Any direction at right angles to a unit vector.
inline dvec3 across(const dvec3& axis) {
  const dvec3 other = std::abs(axis.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  return glm::normalize(glm::cross(axis, other));
}

}  // namespace rondure::detail
