#include "renderer/inverse_spherical/sphere_triangle.h"

#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "renderer/bezier/product.h"
#include "renderer/inverse_spherical/spherical_triangle.h"

namespace rondure {
namespace {

using Real = long double;
using Complex = std::complex<Real>;

struct Spinor {
  Complex a, b;
};

// Of length 1, with s(a, b) = (2 Re(a conj b), 2 Im(a conj b), |a|^2 - |b|^2) = p; the half of the sphere
// decides which of the two numbers is real, so that none comes from a difference of nearly equal ones.
Spinor spinor_of(const dvec3& p) {
  const Real x = p.x, y = p.y, z = p.z;
  const Real r = std::sqrt(x * x + y * y + z * z);
  if (z >= 0) {
    const Real a = std::sqrt((1 + z / r) / 2);
    return {Complex(a), Complex(x, -y) / (2 * r * a)};
  }
  const Real b = std::sqrt((1 - z / r) / 2);
  return {Complex(x, y) / (2 * r * b), Complex(b)};
}

Complex inner(const Spinor& p, const Spinor& q) { return std::conj(p.a) * q.a + std::conj(p.b) * q.b; }

Spinor turned(const Spinor& p, Real angle) {
  const Complex turn = std::polar(Real(1), angle);
  return {turn * p.a, turn * p.b};
}

// Half of the coefficient of u v in L: Bernstein coefficient 110 and the like.
Spinor middle(const Spinor& a, const Spinor& b, Real psi) {
  const Complex plus = std::polar(Real(1), psi), minus = std::conj(plus);
  return {(minus * b.a + plus * a.a) / Real(2), (minus * b.b + plus * a.b) / Real(2)};
}

// The quadratic's real and imaginary parts, by number of the pair.
struct Quadratic {
  TrianglePolynomial<Real> re[2]{TrianglePolynomial<Real>(2), TrianglePolynomial<Real>(2)};
  TrianglePolynomial<Real> im[2]{TrianglePolynomial<Real>(2), TrianglePolynomial<Real>(2)};

  void set(int i, int j, const Spinor& s) {
    re[0].at(i, j) = s.a.real(), im[0].at(i, j) = s.a.imag();
    re[1].at(i, j) = s.b.real(), im[1].at(i, j) = s.b.imag();
  }
};

}  // namespace

TriangleNet sphere_triangle(const std::array<dvec3, 3>& corners) {
  const dvec3 p = glm::normalize(corners[0]), q = glm::normalize(corners[1]), r = glm::normalize(corners[2]);
  if (!(std::abs(orientation(p, q, r)) > 0x1p-40)) {
    throw std::invalid_argument("the three corners lie on one great circle, and span no spherical triangle");
  }
  Spinor a = spinor_of(corners[0]), b = spinor_of(corners[1]), c = spinor_of(corners[2]);
  // Phases such that <a,b>, <b,c> and <c,a> have the same argument psi.
  const Real psi = std::arg(inner(a, b) * inner(b, c) * inner(c, a)) / 3;
  b = turned(b, psi - std::arg(inner(a, b)));
  c = turned(c, psi - std::arg(inner(b, c)));
  Quadratic l;
  l.set(2, 0, a), l.set(0, 2, b), l.set(0, 0, c);
  l.set(1, 1, middle(a, b, psi)), l.set(0, 1, middle(b, c, psi)), l.set(1, 0, middle(c, a, psi));

  const auto square = [](const TrianglePolynomial<Real>& x, const TrianglePolynomial<Real>& y) {
    return add_scaled(multiply(x, x), multiply(y, y), Real(1));
  };
  const auto aa = square(l.re[0], l.im[0]), bb = square(l.re[1], l.im[1]);
  const auto real = add_scaled(multiply(l.re[0], l.re[1]), multiply(l.im[0], l.im[1]), Real(1));
  const auto imaginary = add_scaled(multiply(l.im[0], l.re[1]), multiply(l.re[0], l.im[1]), Real(-1));
  TriangleNet net(4);
  for (std::size_t k = 0; k < net.points.size(); ++k) {
    const Real z = aa.coefficients[k] - bb.coefficients[k], w = aa.coefficients[k] + bb.coefficients[k];
    net.points[k] = dvec4(static_cast<double>(2 * real.coefficients[k]),
                          static_cast<double>(2 * imaginary.coefficients[k]), static_cast<double>(z),
                          static_cast<double>(w));
  }
  // The corners are known better than through their spinors.
  net.at(4, 0) = dvec4(p, 1.0), net.at(0, 4) = dvec4(q, 1.0), net.at(0, 0) = dvec4(r, 1.0);
  return net;
}

}  // namespace rondure
