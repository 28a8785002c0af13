// A face of the cube on the unit sphere, of degree (2, 4): the least with which the sphere can be divided
// into regular patches (Dietz, Hoschek, Juettler 1993, theorem 3.10).
#pragma once

#include "renderer/api/patch.h"

namespace rondure {

// The face about -z, with corners (+-1, +-1, -1) / sqrt 3: (u, v) = (0, 0) at x, y < 0, v along x. 15 control
// points, weights and Jacobian positive.
TensorNet cube_face_2_4();

}  // namespace rondure
