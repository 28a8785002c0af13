#include "renderer/projective/planar_jacobian.h"

#include <algorithm>
#include <cmath>

namespace rondure {
namespace {

using Scalar = TensorPolynomial<long double>;
using Vector = TensorPolynomial<lvec3>;

// The control points with index (i + a, j + b): the sum of the four, weighed with the products of (1 - u), u
// and (1 - v), v, is F.
Vector corner_net(const PlanarBiquadratic& f, int a, int b) {
  Vector net(1, 1);
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      net.at(i, j) = {f.x[i + a][j + b], f.y[i + a][j + b], f.w[i + a][j + b]};
    }
  }
  return net;
}

Scalar determinant(const Vector& a, const Vector& b, const Vector& c) {
  const auto cross = [](const lvec3& x, const lvec3& y) { return glm::cross(x, y); };
  const auto dot = [](const lvec3& x, const lvec3& y) { return glm::dot(x, y); };
  return multiply(multiply(a, b, cross), c, dot);
}

}  // namespace

TensorPolynomial<long double> planar_jacobian(const PlanarBiquadratic& f) {
  const Vector f00 = corner_net(f, 0, 0), f10 = corner_net(f, 1, 0), f01 = corner_net(f, 0, 1),
               f11 = corner_net(f, 1, 1);
  // F_u and F_v are differences of these nets, so that all but four products of three drop out; 4 is the
  // product of the degrees.
  const auto term = [](const Scalar& d, int i, int j) {
    Scalar corner(1, 1);
    corner.at(i, j) = 4;
    return multiply(d, corner);
  };
  Scalar sum = term(determinant(f00, f10, f01), 0, 0);
  sum = add_scaled(sum, term(determinant(f00, f10, f11), 1, 0), 1);
  sum = add_scaled(sum, term(determinant(f00, f11, f01), 0, 1), 1);
  return add_scaled(sum, term(determinant(f10, f11, f01), 1, 1), 1);
}

bool certainly_regular(const PlanarBiquadratic& planar, bool straight_corners) {
  const Scalar d = planar_jacobian(planar);
  long double largest = 0;
  for (const long double c : d.coefficients) largest = std::max(largest, std::abs(c));
  const long double rounding = 0x1p-52L * largest;
  for (int i = 0; i <= d.m; ++i) {
    for (int j = 0; j <= d.n; ++j) {
      const bool corner = (i == 0 || i == d.m) && (j == 0 || j == d.n);
      const long double least = corner && !straight_corners ? rounding : -rounding;
      if (!(d.at(i, j) >= least)) return false;
    }
  }
  return true;
}

std::optional<int> double_until_regular(PlanarBiquadratic& planar, bool straight_corners, int most) {
  for (int doublings = 0; doublings <= most; ++doublings) {
    if (certainly_regular(planar, straight_corners)) return doublings;
    planar.x[1][1] *= 2, planar.y[1][1] *= 2, planar.w[1][1] *= 2;
  }
  return std::nullopt;
}

}  // namespace rondure
