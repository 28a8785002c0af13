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

// Patches in double precision. Where a weight of one is not positive, its degree is raised by up to 4 until
// all of them are; if that does not help, it stays. Quotients are multiplied by a number times which all
// coordinates are doubles, if there is one below 10^6: then nothing is rounded.
struct RoundedNets {
  std::vector<Net> nets;
  std::size_t roundings = 0;  // coordinates that are not the exact ones, times that number
};
RoundedNets nets_of(const std::vector<ExactPatch>& patches);

// The patches, joined as the complex says, their common edges equal to the last bit (weld.h), and turned so
// that their normals agree, and point outward where the complex is closed and orientable: towards the side
// for which the volume inside is positive, part by part.
Surface oriented_surface(const SurfaceComplex& complex, std::vector<Net> nets);

}  // namespace rondure
