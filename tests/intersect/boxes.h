// Boxes of bilinear patches.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/api/surface.h"

namespace rondure {

// Of six bilinear patches, outward; its corners are turned about zero.
inline Surface box(const dvec3& low, const dvec3& high, const dmat3& turn) {
  Surface out;
  out.closed = true;
  const dvec3 corner[2] = {low, high};
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      TensorNet net(1, 1);
      for (int i = 0; i <= 1; ++i)
        for (int j = 0; j <= 1; ++j) {
          dvec3 p;
          p[axis] = corner[side][axis];
          p[b] = corner[side == 1 ? i : j][b], p[c] = corner[side == 1 ? j : i][c];
          net.at(i, j) = dvec4(turn * p, 1.0);
        }
      out.patches.push_back(net);
    }
  return out;
}

inline dmat3 turn_about(const dvec3& axis, double angle) {
  dmat3 out;
  for (int k = 0; k < 3; ++k) {
    dvec3 e(0.0);
    e[k] = 1.0;
    out[k] = std::cos(angle) * e + std::sin(angle) * glm::cross(axis, e) +
             (1.0 - std::cos(angle)) * glm::dot(axis, e) * axis;
  }
  return out;
}

}  // namespace rondure
