// Axis-aligned boxes.
#pragma once

#include <glm/common.hpp>
#include <limits>

#include "renderer/api/patch.h"

namespace rondure {

// Empty until something is added.
struct Box {
  dvec3 low{std::numeric_limits<double>::infinity()};
  dvec3 high{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(low.x <= high.x); }
  void add(const dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
  void add(const Box& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
  dvec3 center() const { return 0.5 * low + 0.5 * high; }
};

}  // namespace rondure
