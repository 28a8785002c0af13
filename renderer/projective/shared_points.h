#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// Makes boundary control points of tensor nets equal bit by bit where they differ by rounding only: by at
// most two or three units in the last place of their largest coordinate. Each takes the value that comes
// first. So two patches that share a curve with its weights share it exactly, and no ray can tell them apart
// there.
void share_control_points(std::vector<Net>& patches);

}  // namespace rondure
