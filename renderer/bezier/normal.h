// The normal of a rational patch as a Bernstein polynomial (Cobb 1988, section 9: the hodograph), and what
// bounds it.
#pragma once

#include "renderer/bezier/product.h"

namespace rondure {

// N = w X_u x X_v + w_u X_v x X + w_v X x X_u, equal to w^3 (f_u x f_v). Degree (3m - 2, 3n - 2) on a tensor
// net of degree (m, n), 3n - 3 on a triangle. Coefficients below the rounding noise of their own sums are
// exactly zero.
using NormalPolynomial = std::variant<TensorPolynomial<dvec3>, TrianglePolynomial<dvec3>>;
NormalPolynomial normal_polynomial(const Net& net);

// The same times a positive power of two that makes its size that of a net of size 1, so that it neither
// overflows nor underflows, whatever the unit of length and of weight.
NormalPolynomial normal_directions(const Net& net);

// Every normal of the patch makes at most the angle acos(cos_angle) with `axis` (unit). cos_angle = -1: no
// bound.
struct NormalCone {
  dvec3 axis{0.0};
  double cos_angle = -1.0;
};

// Valid where w keeps one sign on the patch.
NormalCone normal_cone(const Net& net);

// The cone of the vectors themselves, for pieces of a normal polynomial that was subdivided.
NormalCone cone_of(const dvec3* vectors, std::size_t count);

}  // namespace rondure
