// Surface complexes that come with the library.
#pragma once

#include "renderer/complex/surface_complex.h"

namespace rondure {

// Eight triangles glued as an octahedron's (Vidunas 2005, Definition 2.1). Polygon k has the corners P, Q, R
// of the paper's triangle k + 1: P on the first axis, Q on the second, R on the third, on the negative side
// where bit 2, 1 or 0 of k is set. Edges are glued at equal s, so that half of the triangles are mirrored.
SurfaceComplex octahedron_complex();

// Six squares. Face 2 a + b has axis a at -1 (b = 0) or +1; its parameters run along the other two axes, in
// cyclic order for b = 1 and swapped for b = 0, so that every normal points outward.
SurfaceComplex cube_complex();
// The corners' places on [-1, 1]^3, by [polygon][corner].
std::vector<std::vector<std::array<double, 3>>> cube_corners();

// A torus of 3 k l rhombi: those around the edges of k times l cells of the triangular lattice. Six rhombi
// meet at every lattice point and three at the centre of every triangle. k, l >= 1.
SurfaceComplex torus_complex(int k, int l);
// The corners' places in the lattice's own coordinates, in which the torus repeats after (k, 0) and (0, l);
// by [polygon][corner], each polygon in one piece.
std::vector<std::vector<std::array<double, 2>>> torus_corners(int k, int l);

}  // namespace rondure
