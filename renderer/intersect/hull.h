// Bounds of the projected pair, from its Bernstein coefficients: over a cell, a polynomial lies within their
// range.
#pragma once

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "renderer/intersect/interval.h"

namespace rondure {

struct Hull {
  glm::dvec2 low{1e300}, high{-1e300};

  void add(glm::dvec2 p) { low = glm::min(low, p), high = glm::max(high, p); }
  // Whether one of the two stays further than its `band` from zero.
  bool avoids_zero(glm::dvec2 band) const {
    return low.x > band.x || low.y > band.y || high.x < -band.x || high.y < -band.y;
  }
  glm::dvec2 magnitude() const { return glm::max(-low, high); }
};

inline Hull hull_of(const glm::dvec2* f, std::size_t count) {
  Hull h;
  for (std::size_t k = 0; k < count; ++k) h.add(f[k]);
  return h;
}

// Of one of the two; zero when there are no coefficients.
inline Interval range_of(const glm::dvec2* f, int count, int component) {
  if (count == 0) return {};
  Interval r{f[0][component], f[0][component]};
  for (int k = 1; k < count; ++k) r = {std::min(r.low, f[k][component]), std::max(r.high, f[k][component])};
  return r;
}

}  // namespace rondure
