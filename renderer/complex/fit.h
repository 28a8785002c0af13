// Control points for a wanted shape.
#pragma once

#include "renderer/complex/complex_surface.h"

namespace rondure {

// Points in space for every coefficient of every polygon, [polygon][coefficient].
using CoefficientTargets = std::vector<std::vector<dvec3>>;

// Where the coefficients of degree n lie when the polygons are flat (triangles) or bilinear (squares) between
// their corners' places, [polygon][corner].
CoefficientTargets flat_targets(const SurfaceComplex& complex, int n,
                                const std::vector<std::vector<dvec3>>& corners);

// The control points for which the coefficients of the sum of P_k f_k come nearest to the targets, in the sum
// of squares. The basis must be of polynomials, with as many coefficients as there are targets.
std::vector<BlendPoint> fitted_points(const GcBasis& basis, const CoefficientTargets& targets);

}  // namespace rondure
