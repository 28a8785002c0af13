// Integrals over one piece of a patch, each with a bound on its error.
//
// The integrands are |N| / w^3 (area) and det(X, X_u, X_v) / w^3 (three times the volume of the cone over the
// piece from the origin), times 1, f_i and f_i f_j for the point f = X / w. Gauss-Legendre quadrature with n
// nodes in each direction. Its error is bounded through the complex plane (Trefethen, Approximation Theory
// and Approximation Practice, Theorem 19.3): for an integrand analytic and at most M inside the Bernstein
// ellipse of parameter rho about an interval of length 1, it is below 32/15 M rho^(-2n) / (1 - rho^-2). One
// direction at a time is made complex. There the Legendre coefficients c_kl of w, X, N and the determinant,
// all of them polynomials that the nodes determine, give bounds from above and below: |P_k| <= (rho^k +
// rho^-k) / 2 on the ellipse. So w keeps away from zero where |c_00| outweighs the rest, and N . N too, where
// the square root is then analytic. Where no ellipse will do (a singular corner) the bound is twice the
// largest integrand, and the caller subdivides.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "renderer/bezier/gauss_rule.h"

namespace rondure {

using lvec3 = glm::vec<3, long double>;
using lvec4 = glm::vec<4, long double>;

// Of a density over points p: its integral, that of p, and that of p p^T (xx, xy, xz, yy, yz, zz).
struct MomentSums {
  long double total = 0.0L;
  lvec3 first{0.0L};
  std::array<long double, 6> second{};
};

// Bounds on errors, by order of the moment: any coordinate's.
using OrderErrors = std::array<double, 3>;

// A Bernstein polynomial over the unit square.
struct LongNet {
  int m = 0, n = 0;
  std::vector<lvec4> points;  // [i * (n + 1) + j]
  double noise = 0.0;         // how far a coordinate of one may be off

  double hull() const;  // the longest of the points, in four dimensions
};

// A piece of a tensor-product patch, over the unit square. Its derivatives have nets of their own, so that
// their errors stay relative to them however small the piece is.
struct IntegrationCell {
  LongNet net, du, dv;
  // Edges u = 0, u = 1, v = 0, v = 1 along which N vanishes but for rounding: it is divided by their
  // distances.
  std::array<bool, 4> collapsed{};
  double normal_noise = 0.0;  // what N is on those edges

  MomentSums area, cone;     // cone: of det / w^3 as it stands
  lvec3 vector_area{0.0L};   // integral of N / w^3
  OrderErrors area_error{};  // of the quadrature
  OrderErrors cone_error{};
  OrderErrors area_rounding{};
  OrderErrors cone_rounding{};
  bool split_u = true;  // the direction that has the larger error
};

// Fills in the sums and their errors. Coordinates and weights should be of a size near 1. Errors are infinite
// where the weight may vanish.
void integrate(IntegrationCell& cell, const GaussRule& in_u, const GaussRule& in_v);

// A bound on |N| along an edge, numbered as in `collapsed`; or a value that it takes there, when that is more
// than `enough`.
double edge_normal_bound(const IntegrationCell& cell, int edge, const GaussRule& in_u, const GaussRule& in_v,
                         double enough);

}  // namespace rondure
