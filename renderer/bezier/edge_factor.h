// Normal polynomials without the powers of u, 1 - u, v and 1 - v (u, v and w on a triangle) that divide them:
// on an edge where the control points coincide every normal vanishes.
#pragma once

#include "renderer/bezier/product.h"

namespace rondure {

using TensorNormal = TensorPolynomial<dvec3>;
using TriangleNormal = TrianglePolynomial<dvec3>;

// `factor` is multiplied by what is divided out. A power divides where all coefficients without it are zero,
// exactly: N has such zeros (renderer/bezier/normal.h).
TensorNormal without_edges(TensorNormal normal, TensorPolynomial<double>& factor);
TriangleNormal without_edges(TriangleNormal normal, TrianglePolynomial<double>& factor);

}  // namespace rondure
