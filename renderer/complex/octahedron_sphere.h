// The unit sphere as geometrically continuous functions on the octahedron.
#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// Eight patches of degree 6 in the order of octahedron_complex, each the exact octant of the sphere; patches
// with an odd number of mirrored axes have inward normals. Farin, Piper and Worsey's octant of degree 4
// (1987) does not satisfy Vidunas's conditions, and no net of degree 2 does. In the spinors of Dietz, Hoschek
// and Juettler (1993) the one used here is (u + v + w) times that octant's, plus a multiple of u v w.
// Positive weights, each coordinate within an eps or two of the numbers in Q(sqrt 2, sqrt 3).
std::vector<TriangleNet> octahedron_sphere();

}  // namespace rondure
