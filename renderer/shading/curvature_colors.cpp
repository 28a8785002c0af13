#include "renderer/shading/curvature_colors.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "renderer/bezier/rational.h"

namespace rondure {

dvec3 diverging_color(double t) {
  constexpr dvec3 blue(0.02, 0.1, 0.55), grey(0.8), red(0.6, 0.03, 0.03);
  const double s = 2.0 * std::clamp(t, 0.0, 1.0) - 1.0;
  return glm::mix(grey, s < 0.0 ? blue : red, std::fabs(s));
}

dvec3 curvature_color(const CurvatureColors& colors, const Net& net, double u, double v,
                      const dvec3& otherwise) {
  const Curvature at = curvature(net, u, v);
  const double value = colors.of == CurvatureColors::Kind::gaussian ? at.gaussian : at.mean;
  if (std::isnan(value)) return otherwise;
  // Clamped first: an infinite curvature, and a range as wide as doubles are, or as narrow, must not make
  // inf / inf or 0 / 0.
  const double inside = std::clamp(value, colors.low, colors.high), width = colors.high - colors.low;
  const double part = std::isfinite(width)
                          ? (inside - colors.low) / width
                          : (0.5 * inside - 0.5 * colors.low) / (0.5 * colors.high - 0.5 * colors.low);
  return diverging_color(part);
}

}  // namespace rondure
