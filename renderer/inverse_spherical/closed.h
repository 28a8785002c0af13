// Whether patches bound a solid: every side is shared by two of them, as one curve run through in opposite
// ways.
#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// True when the sides of the triangular patches pair up: both ends agree, and so do as many points between as
// decide that two rational curves of their degrees are one (n1 + n2 + 1), to 64 units of rounding of the
// largest coordinate. Degrees may differ. Every patch must have an outward normal already.
bool closes_up(const std::vector<TriangleNet>& patches);

}  // namespace rondure
