// Triangular patches in tensor-product form, exactly: the composition with a bilinear map of the unit square
// into the triangle has degree (n, n).
#pragma once

#include <array>

#include "renderer/api/patch.h"

namespace rondure {

// The part over the quadrilateral with these corners (u, v), at (s, t) = (0, 0), (1, 0), (0, 1), (1, 1).
TensorNet tensor_part(const TriangleNet& net, const std::array<dvec2, 4>& corners);

// The whole triangle as one patch: (u, v, w) = (1 - s, s (1 - t), s t). The side s = 0 collapses to the
// corner u = 1.
TensorNet as_degenerate_tensor(const TriangleNet& net);

// The triangle cut from its centroid to the middles of its sides: three patches without a degenerate corner,
// each with (s, t) = (0, 0) at the triangle's corner of its number and (1, 1) at the centroid. Orientation
// stays.
std::array<TensorNet, 3> as_three_tensors(const TriangleNet& net);

}  // namespace rondure
