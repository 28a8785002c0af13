// Geometrically continuous functions as an algebra: sums, products and quotients of such functions are such
// functions (Vidunas 2005, end of section 3).
#pragma once

#include <string>

#include "renderer/complex/spline_space.h"

namespace rondure {

// A quotient of polynomials on every polygon, in the order of the complex's polygons.
struct GcFunction {
  std::vector<PolygonPolynomial> numerators, denominators;
};

GcFunction constant_function(const SurfaceComplex& complex, const Exact& value);
GcFunction operator*(const GcFunction& f, const GcFunction& g);
// f + factor g; equal denominators stay as they are.
GcFunction add(const GcFunction& f, const GcFunction& g, const Exact& factor);
// f / g; g must have no zero.
GcFunction quotient(const GcFunction& f, const GcFunction& g);

// Whether all conditions of Definition 5.2 hold, exactly.
bool is_gc1(const SurfaceComplex& complex, const GcFunction& f);

// Largest discontinuity of the value and of the derivative over all joins, sampled at 17 places on each.
struct GcDefect {
  double value = 0.0, derivative = 0.0;
};
GcDefect gc1_defect(const SurfaceComplex& complex, const GcFunction& f);

// At (u, v) of api/patch.h.
double value_at(const GcFunction& f, int polygon, double u, double v);

// Functions with the same denominators, to be blended with control points.
struct GcBasis {
  std::vector<std::string> names;
  std::vector<PolygonPolynomial> denominators;            // of the polygons
  std::vector<std::vector<PolygonPolynomial>> functions;  // numerators by [function][polygon]
};

GcFunction function_of(const GcBasis& basis, std::size_t k);
// Named after the coefficient that each is dual to: "polygon:ijk", or "polygon:i,j" on squares.
GcBasis basis_of(const SurfaceComplex& complex, const SplineSpace& space);

}  // namespace rondure
