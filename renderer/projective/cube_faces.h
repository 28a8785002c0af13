// The faces of a cube on the unit sphere: one of them, and how the other five come from it.
#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// A signed permutation of the axes: coordinate c of the image is sign[c] times coordinate from[c].
struct AxisRotation {
  int from[3];
  double sign[3];
};

TensorNet rotated(const TensorNet& net, const AxisRotation& turn);

// The faces about -z, +z, +x, -x, +y, -y from the one about -z. Where that is symmetric as a cube is,
// neighbours share the control points of their common edge bit for bit.
std::vector<Net> cube_of(const TensorNet& south);

// The face about -z, with corners (+-1, +-1, -1) / sqrt 3, of degree (2, 4): the least with which the sphere
// can be divided into regular patches (Dietz, Hoschek, Juettler 1993, theorem 3.10). (u, v) = (0, 0) at x, y
// < 0, v along x. 15 control points, weights and Jacobian positive.
TensorNet cube_face_2_4();

}  // namespace rondure
