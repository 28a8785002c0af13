// Control points that neighbouring patches have in common.
#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// Makes boundary control points of tensor nets equal bit by bit where they differ by rounding only, that is
// by two eps of their largest coordinate at most. Each takes the value that comes first. So two patches that
// share a curve with its weights share it exactly, and no ray can tell them apart there.
void share_control_points(std::vector<Net>& patches);

}  // namespace rondure
