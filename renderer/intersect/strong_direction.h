// Which combination of a ray's two planes the patch moves along most.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace rondure {

// The unit vector c for which the gradient (c . du, c . dv) is longest: the greater eigenvector of J J^T,
// J = (du dv). Across it, at (-c.y, c.x), the gradient is shortest. (1, 0) where J is zero.
inline glm::dvec2 strong_direction(glm::dvec2 du, glm::dvec2 dv) {
  // The fourth power of a gradient would leave the range of doubles on small surfaces.
  const double size =
      std::fmax(std::fmax(std::fabs(du.x), std::fabs(du.y)), std::fmax(std::fabs(dv.x), std::fabs(dv.y)));
  if (!(size > 0.0)) return {1.0, 0.0};
  du /= size, dv /= size;
  const double xx = du.x * du.x + dv.x * dv.x, yy = du.y * du.y + dv.y * dv.y, xy = du.x * du.y + dv.x * dv.y;
  const double split = 0.5 * (xx - yy), root = std::sqrt(split * split + xy * xy);
  const glm::dvec2 c = split > 0.0 ? glm::dvec2(split + root, xy) : glm::dvec2(xy, root - split);
  const double length = glm::length(c);
  return length > 0.0 ? c / length : glm::dvec2(1.0, 0.0);
}

}  // namespace rondure
