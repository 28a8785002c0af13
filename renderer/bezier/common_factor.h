// A normal polynomial without the scalar polynomial that divides its three coordinates.
//
// On a patch of a quadric X^T B X = 0 the tangent plane is B X, of the patch's own degree, times a Jacobian J
// (on the sphere N = J (x, y, z)). Collapsed edges, a patch reparametrised by a planar map, and denominators
// leave factors of their own. None is asked for by name: the reduced normal is the polynomial vector of least
// degree that is parallel to N.
#pragma once

#include "renderer/bezier/curvature_polynomial.h"
#include "renderer/bezier/normal.h"

namespace rondure {

struct ReducedNormal {
  NormalPolynomial direction;  // the largest coordinate of a coefficient is 1 in size
  ScalarPolynomial factor;     // normal = factor * direction; positive where the patch is not folded over
  double residual = 0.0;       // |normal - factor * direction| / |normal|, largest coefficients
};

// A factor is divided out when the residual then stays below 2^-40. Otherwise, and where the search would
// take more than some seconds (beyond degree (11, 11) or so), only powers of u, 1 - u, v and 1 - v (u, v and
// w on a triangle) are. The values of direction / |direction| are good to rounding, at singular points too;
// its coefficients only as far as a product determines its factors, some 1e-10 on a biquartic patch.
ReducedNormal reduced_normal(const NormalPolynomial& normal);

}  // namespace rondure
