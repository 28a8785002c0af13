// The angle between two directions of any lengths, in radians.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/api/patch.h"

namespace rondure {

// Good to some roundoffs of 1, near 0 and pi too. 0 where one of them is zero.
inline double angle_between(const dvec3& a, const dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace rondure
