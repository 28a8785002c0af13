// False colours for the curvature of a patch: they stand for the albedo, so that a picture shows its sign and
// size.
#pragma once

#include "renderer/api/patch.h"

namespace rondure {

// Signs as in bezier/rational.h: an outward sphere of radius r has Gaussian curvature 1 / r^2, mean -1 / r.
struct CurvatureColors {
  enum class Kind { gaussian, mean };

  Kind of = Kind::gaussian;
  double low = -1.0, high = 1.0;  // 1 / length^2 for Gaussian, 1 / length for mean curvature; low < high
};

// Blue at t <= 0, a light grey at 1/2, red at t >= 1, and linear mixtures between: linear RGB, in [0, 1].
// Zero curvature is grey where the range has it in the middle.
dvec3 diverging_color(double t);

// The colour of the exact curvature at (u, v); `otherwise` where the surface has no curvature.
dvec3 curvature_color(const CurvatureColors& colors, const Net& net, double u, double v,
                      const dvec3& otherwise);

}  // namespace rondure
