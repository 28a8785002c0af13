// Stereographic projection about any point of the unit sphere.
#pragma once

#include "renderer/projective/extended.h"

namespace rondure {

// Right-handed, orthonormal. The sphere is projected from -centre to the plane that touches it at the centre,
// with axes e1 and e2: seen from outside the plane has its usual orientation.
struct StereographicFrame {
  lvec3 e1, e2, centre;

  // `direction` need not have length 1, but must not be zero.
  explicit StereographicFrame(const lvec3& direction);

  // The homogeneous image (X, Y, W) of the point (x, w) of the sphere. W / w is 1 + cos of the angle from the
  // centre: 1 - z in Cobb's position, where the centre is the south pole. Being linear, this takes the
  // control points of a curve on the sphere to those of its image.
  lvec3 project(const lvec3& x, long double w) const {
    return {2 * glm::dot(e1, x), 2 * glm::dot(e2, x), w + glm::dot(centre, x)};
  }
};

}  // namespace rondure
