// N inverse spherical patches around a vertex, with one tangent plane along every spoke and at the vertex
// (Casciola and Morigi 2004, Figure 7; Loop 1994 for the order of the choices).
#pragma once

#include "renderer/inverse_spherical/iss.h"

namespace rondure {

// Patch m = 0..N-1 has the corners (centre, P_m, P_m+1), with P_m = centre + cos(2 pi m / N) a + sin(...) b:
// an affine image of the regular N-gon in a plane off the origin. Spoke m runs from the centre to P_m.
struct FanDomain {
  int sides = 6;
  dvec3 centre{0.0, 0.0, 1.0}, a{1.0, 0.0, 0.0}, b{0.0, 1.0, 0.0};

  dvec3 corner(int m) const;
};

// The fan that is smooth and closest in kind to the N nets of weights given (triangle_index order, degree n
// >= 2, i belongs to the centre; spoke m is the side k = 0 of net m, which alone is read there). With C =
// cos(2 pi / N), E the weights of a spoke and R+, R- the rows beside it, Proposition 2 reads R-_j + R+_j = 2
// C E_{j+1} + (2 - 2 C) E_j. Kept are the centre's weight, the best plane through the spokes' first weights,
// the twists 1 (N = 4: their part that can be), and the spokes from the third weight on; the spokes' second
// weights follow from the twists, since the converse has no solution for even N, and each pair R-, R+ is
// moved by equal amounts. A fan that is smooth already stays as it is. Throws std::invalid_argument for N < 3
// and for weights that come out not positive.
std::vector<PlanarIss> smooth_fan(const FanDomain& domain, int n, std::vector<std::vector<double>> weights);

}  // namespace rondure
