// Closed surfaces of eight inverse spherical patches, one on every octant, with one tangent plane everywhere.
//
// All eight have planar projection domains on |x| + |y| + |z| = 1. From degree 3 on, the weights inside the
// octants are free, 4 (n - 1)(n - 2) of them, and those on the edges follow: the paper thought such models
// out of reach, since its Proposition 2 needs coplanar domains.
#pragma once

#include "renderer/inverse_spherical/iss.h"

namespace rondure {

// `interior[o]` belongs to the octant whose bits 0, 1, 2 make x, y, z negative: a vector in triangle_index
// order of degree n >= 3 whose entries with i, j, k > 0 are read. The corners of patch o are +-e1, +-e2, +-e3
// in this order, so that half of the patches are oriented inwards. Positive interior weights give positive
// ones.
std::array<PlanarIss, 8> octant_model(int n, const std::array<std::vector<double>, 8>& interior);

}  // namespace rondure
