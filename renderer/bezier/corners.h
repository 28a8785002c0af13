// The control points at a patch's corners, which are the patch there.
#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// (u, v) = (0, 0), (1, 0), (0, 1), (1, 1).
inline std::vector<dvec4> corners_of(const TensorNet& net) {
  return {net.at(0, 0), net.at(net.m, 0), net.at(0, net.n), net.at(net.m, net.n)};
}
// u = 1, v = 1, and both 0.
inline std::vector<dvec4> corners_of(const TriangleNet& net) {
  return {net.at(net.n, 0), net.at(0, net.n), net.at(0, 0)};
}

}  // namespace rondure
