// Spaces of geometrically continuous spline functions on a complex (Vidunas 2005, section 3).
#pragma once

#include "renderer/complex/null_space.h"

namespace rondure {

struct SplineSpace {
  int degree = 0;
  std::vector<int> offsets;                     // of the polygons' coefficients (coefficient_offsets)
  std::vector<PolygonPolynomial> denominators;  // of the polygons; empty for polynomials
  NullSpace solutions;

  std::size_t dimension() const { return solutions.basis.size(); }
};

// All unknowns, those first that should be expressed by the others: nearer to the boundary, then nearer to a
// corner.
std::vector<int> elimination_order(const SurfaceComplex& complex, int n);

// Polynomials of degree n on every polygon, or over the given denominators, that are continuous and
// geometrically continuous. Coefficients farther from the boundary are preferred as free ones, so that basis
// functions are dual to them and local where the complex allows it. Exact for an exact complex; otherwise see
// rounded_null_space.
SplineSpace spline_space(const SurfaceComplex& complex, int n,
                         std::vector<PolygonPolynomial> denominators = {});

// The numerator of a basis function on a polygon.
PolygonPolynomial numerator_of(const SurfaceComplex& complex, const SplineSpace& space, std::size_t function,
                               int polygon);

// The polygons on which a basis function is not zero.
std::vector<int> support_of(const SplineSpace& space, std::size_t function);

}  // namespace rondure
