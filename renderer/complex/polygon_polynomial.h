// Polynomials on the polygons of a complex, in Bernstein form and exact arithmetic.
#pragma once

#include <vector>

#include "renderer/complex/edge_function.h"

namespace rondure {

// Of degree n on a triangle, (n, n) on a square; coefficients in the order of TriangleNet and TensorNet.
struct PolygonPolynomial {
  int sides = 3;
  int degree = 0;
  std::vector<Exact> coefficients;
};

constexpr int coefficient_count(int sides, int n) {
  return sides == 3 ? (n + 1) * (n + 2) / 2 : (n + 1) * (n + 1);
}

// Exponents of a coefficient: {i, j, k} of u, v, w on a triangle, {i, j, 0} of u and v on a square.
std::array<int, 3> exponents_of(int sides, int n, int coefficient);
// How many steps a coefficient is from the boundary: 0 on an edge.
int steps_from_boundary(int sides, int n, int coefficient);

PolygonPolynomial constant_polynomial(int sides, const Exact& value);
PolygonPolynomial operator*(const PolygonPolynomial& a, const PolygonPolynomial& b);
// a + factor b; degrees may differ.
PolygonPolynomial add(const PolygonPolynomial& a, const PolygonPolynomial& b, const Exact& factor);
PolygonPolynomial elevated(const PolygonPolynomial& p, int degree);

// What one basis polynomial is along an edge: its value and its derivative along `inward`
// (renderer/complex/surface_complex.h), as polynomials of s. Those that vanish in both are left out.
struct EdgeTrace {
  int coefficient;
  EdgePolynomial value, inward;
};
std::vector<EdgeTrace> edge_traces(int sides, int n, int edge);
// The same of a polynomial.
EdgeTrace edge_trace(const PolygonPolynomial& p, int edge);

}  // namespace rondure
