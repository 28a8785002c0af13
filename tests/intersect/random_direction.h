// Directions spread evenly over the sphere.
#pragma once

#include <glm/geometric.hpp>
#include <random>

#include "renderer/api/patch.h"

namespace rondure {

inline dvec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  for (;;) {
    const double x = normal(random), y = normal(random), z = normal(random);
    const dvec3 d(x, y, z);
    if (glm::length(d) > 1e-3) return glm::normalize(d);
  }
}

}  // namespace rondure
