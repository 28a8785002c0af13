// The flat pieces between the control points of a net.
#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// The n^2 plane triangles of a triangular net of degree n, or the m n bilinear patches of a tensor-product
// net, oriented as the net is. Pieces without area, and those that reach infinity, are left out.
std::vector<Net> control_surface(const Net& net);

}  // namespace rondure
