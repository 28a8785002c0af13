// Transversal data that fits every vertex: what a complex takes when only its edges' gluing is given.
#pragma once

#include "renderer/complex/surface_complex.h"

namespace rondure {

struct Gluing {
  EdgeRef p, q;
  bool reversed = true;  // s meets 1 - s: so it is when both polygons are anticlockwise as seen from outside
};

// Around a vertex with N corners the derivatives along the edges behave as those along the spokes of a
// regular N-gon, e_{j-1} + e_{j+1} = 2 cos(2 pi / N) e_j, and along an edge 2 cos(2 pi / N) is blended
// from end to end (Hahn 1989): linearly, or as a cubic where that would give opposite edges at a vertex with
// N = 4 different slopes. Triangles with N = 4 everywhere make Vidunas's octahedron (Definition 2.1). A
// vertex on the boundary counts as one of N = 4 up to three corners; more of them fill some 175 degrees. The
// result is exact where all N are 3, 4 or 6, for which the
// cosine is rational. `sides` must be 3 or 4, and every edge in one gluing at most.
SurfaceComplex regular_complex(const std::vector<int>& sides, const std::vector<Gluing>& gluings);

}  // namespace rondure
