// Triangles of the unit sphere as quartic inverse spherical surfaces (Casciola and Morigi 2004, Remark 7.3;
// Farin, Piper and Worsey 1987 for the octant): exact, sides on great circles, no degenerate corner.
#pragma once

#include "renderer/inverse_spherical/iss.h"

namespace rondure {

// The spherical triangle with corners along these vectors (any length). The map is s(L) where s takes a pair
// of complex numbers to the sphere (the Hopf map) and L is a quadratic in (u, v, w) with values there, L_200
// and so on being the corners. Parameters run along a side the same way whatever lies beside it. Throws
// std::invalid_argument for corners on one great circle.
TriangleNet sphere_triangle(const std::array<dvec3, 3>& corners);

}  // namespace rondure
