// Surfaces from geometrically continuous functions and control points (Vidunas 2005, Theorem 2.3): where all
// patches are regular, they meet with one tangent plane everywhere.
#pragma once

#include "renderer/api/surface.h"
#include "renderer/complex/gc_function.h"

namespace rondure {

struct BlendPoint {
  std::array<Exact, 3> point{0, 0, 0};
  Exact weight = 1;
};

// A patch as homogeneous polynomials of one degree: w x, w y, w z, w.
using ExactPatch = std::array<PolygonPolynomial, 4>;

// One patch for every polygon, from a point for every function. Without weights: sum of P_k f_k. With them:
// the quotient sum of w_k P_k f_k / sum of w_k f_k, whose denominator must not vanish.
std::vector<ExactPatch> blend(const GcBasis& basis, const std::vector<BlendPoint>& points, bool weighted);

// Rounded to double. Where a weight of the net is not positive, the degree is raised by up to 4 until all of
// them are; if that does not help, it stays.
Net net_of(const ExactPatch& patch);

// The patches turned so that their normals agree, and point outward where the complex is closed and
// orientable: towards the side for which the volume inside is positive, part by part.
Surface oriented_surface(const SurfaceComplex& complex, std::vector<Net> nets);

}  // namespace rondure
