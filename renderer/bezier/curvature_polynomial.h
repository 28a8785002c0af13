// The fundamental forms and the curvatures of a rational patch as Bernstein polynomials (Cobb 1988, section
// 9; the formulas follow from F ^ F_u ^ F_v for the homogeneous net F = (X, w)).
//
// With N the normal polynomial of renderer/bezier/normal.h, D_ab = <the tangent plane (N, N_w), F_ab>, and
// E = (w X_u - w_u X)^2, F and G alike:
//
//   Gaussian curvature = gaussian / (N . N)^2             gaussian = w^4 (D_uu D_vv - D_uv^2)
//   mean curvature     = mean / (2 (N . N)^(3/2)) sign w  mean     = w (E D_vv - 2 F D_uv + G D_uu)
//
// Signs as in renderer/bezier/rational.h: an outward sphere of radius r has mean curvature -1 / r.
#pragma once

#include <variant>

#include "renderer/bezier/normal.h"
#include "renderer/bezier/product.h"

namespace rondure {

using ScalarPolynomial = std::variant<TensorPolynomial<double>, TrianglePolynomial<double>>;

// Degrees on a tensor net of degree (m, n), each the least that holds for every net: d_uu (4m - 6, 4n - 2),
// d_uv (4m - 4, 4n - 4), d_vv (4m - 2, 4n - 6), normal_square (6m - 4, 6n - 4), gaussian (12m - 8, 12n - 8),
// mean (9m - 6, 9n - 6). On a triangle of degree n: d_ab 4n - 5, normal_square 6n - 6, gaussian 12n - 10,
// mean 9n - 7. What vanishes because m or n is below 2 has degree 0 in place of a negative one.
struct CurvaturePolynomials {
  ScalarPolynomial weight;  // w itself
  ScalarPolynomial d_uu, d_uv, d_vv;
  ScalarPolynomial normal_square;
  ScalarPolynomial gaussian, mean;
};

// All are zero where a direction has degree 0: such a patch has no normal. Coefficients are good to some tens
// of eps of the largest sum of products; the net's unit of length enters as it is, so that nets of a size
// near 1e40 and beyond overflow.
CurvaturePolynomials curvature_polynomials(const Net& net);

// Value by de Casteljau's algorithm, of any degree, for (u, v) in the domain.
double polynomial_value(const ScalarPolynomial& p, double u, double v);
dvec3 polynomial_value(const NormalPolynomial& p, double u, double v);

}  // namespace rondure
