// Two Bernstein polynomials over a piece of a patch's domain, at 50 digits: the oracle's own algebra.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <vector>

namespace rondure::oracle {

// 169 bits; without expression templates, which cost more than they save at this size.
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using Real2 = std::array<Real, 2>;

inline Real2 operator+(const Real2& a, const Real2& b) { return {a[0] + b[0], a[1] + b[1]}; }
inline Real2 operator-(const Real2& a, const Real2& b) { return {a[0] - b[0], a[1] - b[1]}; }
inline Real2 operator*(const Real& s, const Real2& a) { return {s * a[0], s * a[1]}; }
inline Real size_of(const Real2& a) { return std::max(Real(abs(a[0])), Real(abs(a[1]))); }

// Degree and order of coefficients. Tensor product: (i, j) of degrees (m, n). Triangle: (i, j) of u^i v^j
// w^(n-i-j). Either way i is the outer index. An edge is a direction to halve along: u and v; or from corner
// to corner of a triangle, u = 1 to v = 1, on to u = v = 0, and back.
struct Degrees {
  bool triangle = false;
  int m = 0, n = 0;  // of a triangle m = n

  int edges() const { return triangle ? 3 : 2; }
  std::size_t size() const;
  std::size_t at(int i, int j) const;
  // The coefficients that halving along the edge mixes, in lines that start at the edge's start.
  std::vector<std::vector<std::size_t>> lines(int edge) const;
  Degrees derived(int parameter) const;
};

// Values and derivatives at a point of the piece.
struct Jet {
  Real2 value, da, db, daa, dab, dbb;
};

class PolynomialPair {
 public:
  Degrees degrees;
  std::vector<Real2> c;

  PolynomialPair() = default;
  PolynomialPair(const Degrees& d, std::vector<Real2> coefficients)
      : degrees(d), c(std::move(coefficients)) {}

  // The two halves along an edge.
  std::array<PolynomialPair, 2> halves(int edge) const;
  // Over the piece enlarged about its middle: by `by` beyond each side of a square, by as much (barycentric)
  // beyond each side of a triangle.
  PolynomialPair enlarged(const Real& by) const;
  // By the first (0) or second (1) parameter of the piece; of degree 0 where it does not depend on it.
  PolynomialPair derivative(int parameter) const;
  Real2 operator()(const Real& a, const Real& b) const;
  // How much the polynomials change along an edge.
  Real change(int edge) const;
};

Jet jet(const PolynomialPair& f, const Real& a, const Real& b);

}  // namespace rondure::oracle
