// Projective 3-space as pairs of complex numbers, in which delta and the circles on the sphere are simple:
// (a, b) = (p1 + i p2, p0 - i p3) has the stereographic image a / b, its complex multiples are the points of
// one projecting line, and lines that meet the same three projecting lines go to the same circle.
#pragma once

#include <cmath>
#include <complex>

#include "renderer/projective/generalised_projection.h"

namespace rondure {

using Complex = std::complex<long double>;

struct Spinor {
  Complex a, b;

  friend Spinor operator+(const Spinor& p, const Spinor& q) { return {p.a + q.a, p.b + q.b}; }
  friend Spinor operator*(const Complex& c, const Spinor& p) { return {c * p.a, c * p.b}; }
};

inline Spinor to_spinor(const lvec4& p) { return {{p[1], p[2]}, {p[0], -p[3]}}; }
inline lvec4 to_point(const Spinor& s) { return {s.b.real(), s.a.real(), s.a.imag(), -s.b.imag()}; }

// Zero exactly when both go to the same point of the sphere. For spinors of length 1 its modulus is half the
// distance of their images.
inline Complex det(const Spinor& p, const Spinor& q) { return p.a * q.b - p.b * q.a; }

// |s|^2, the weight of delta(s).
inline long double norm(const Spinor& s) { return std::norm(s.a) + std::norm(s.b); }
inline lvec4 delta(const Spinor& s) { return delta(to_point(s)); }

// The spinor of length 1 that goes to this point of the unit sphere and whose larger part is real. z is
// taken from x and y where that has more digits.
inline Spinor spinor_at(const lvec3& x) {
  const long double more = (1 + std::abs(x.z)) / 2, root = std::sqrt(more);
  const Complex less = Complex(x.x, x.y) / (2 * root);
  const Spinor s = x.z > 0 ? Spinor{root, std::conj(less)} : Spinor{less, root};
  const long double length = std::sqrt(norm(s));
  return (1 / length) * s;
}

// The factor g of modulus 1 with which (1 - t) p + t g q, t in [0, 1], goes to the arc from p to q that
// passes through r: from lemma 3.7 with the sign that the segment needs, as with the printed one it avoids r.
// For p and q of length 1 that is the symmetric quadratic parametrisation. r must differ from both.
inline Complex arc_phase(const Spinor& p, const Spinor& r, const Spinor& q) {
  const Complex g = -std::conj(det(r, q)) * det(r, p);
  return g / std::abs(g);
}

}  // namespace rondure
