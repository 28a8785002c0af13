// Where a patch of the unit sphere shows a direction, by subdivision alone.
#pragma once

#include <optional>

#include "renderer/api/patch.h"

namespace rondure {

// The parameters of the net's point in the direction n, to rounding; of several those whose point is nearest.
// Slower than Newton's method, but it finds them without a start, and beside singular points. `rounding`: how
// many times what doubles of its own size are rounded by the net may be beside what it stands for: sides that
// neighbours share are as far apart, and a direction between them is in none of the nets.
std::optional<dvec2> search_direction(const Net& net, const dvec3& n, double rounding = 1.0);

}  // namespace rondure
