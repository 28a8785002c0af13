// The linear equations between Bernstein coefficients that make functions on a complex geometrically
// continuous (Vidunas 2005, Definition 5.2).
#pragma once

#include <utility>
#include <vector>

#include "renderer/complex/polygon_polynomial.h"
#include "renderer/complex/surface_complex.h"

namespace rondure {

// (unknown, coefficient), in order of the unknowns, no coefficient 0: an equation "their sum is 0", or a
// vector.
using SparseRow = std::vector<std::pair<int, Exact>>;

// Where the coefficients of each polygon begin among the unknowns; the last entry is their number.
std::vector<int> coefficient_offsets(const SurfaceComplex& complex, int n);

// Polynomials of degree n on every polygon. With `denominators`, one for each polygon and without a zero
// there, the functions are those polynomials over them; empty stands for 1.
std::vector<SparseRow> gc1_conditions(const SurfaceComplex& complex, int n,
                                      const std::vector<PolygonPolynomial>& denominators);

// What is left of value and inward derivative when the second polygon's are taken from the first's, along one
// join, for one function; both 0 when it is continuous and geometrically continuous there.
struct JoinDefect {
  EdgeFunction value, derivative;
};
JoinDefect join_defect(const EdgeJoin& join, const PolygonPolynomial& p_numerator,
                       const PolygonPolynomial& p_denominator, const PolygonPolynomial& q_numerator,
                       const PolygonPolynomial& q_denominator);

}  // namespace rondure
