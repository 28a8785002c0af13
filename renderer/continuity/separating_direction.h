// A plane through the origin that has vectors on one of its sides.
#pragma once

#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// A unit vector whose products with all of the vectors are above `margin`, if one is found: their mean is
// tried, and while some vector is not, a share of that one is added (Rosenblatt's perceptron, 1958).
inline std::optional<dvec3> separating_direction(const std::vector<dvec3>& vectors, double margin) {
  constexpr int most_rounds = 12;
  dvec3 sum(0.0);
  for (const dvec3& n : vectors) sum += n;
  for (int round = 0; round < most_rounds; ++round) {
    const double length = glm::length(sum);
    if (!(length > 0.0)) return std::nullopt;
    const dvec3 direction = sum / length;
    double low = std::numeric_limits<double>::infinity();
    const dvec3* worst = nullptr;
    for (const dvec3& n : vectors) {
      const double height = glm::dot(n, direction);
      if (height < low) low = height, worst = &n;
    }
    if (low > margin) return direction;
    const double size = worst ? glm::length(*worst) : 0.0;
    if (!(size > 0.0)) return std::nullopt;
    sum = direction + *worst / size;
  }
  return std::nullopt;
}

}  // namespace rondure
