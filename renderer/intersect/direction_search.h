// Where a patch of the unit sphere shows a direction, by subdivision alone.
#pragma once

#include <optional>

#include "renderer/api/patch.h"

namespace rondure {

// The parameters of the net's point in the direction n, to rounding; of several those whose point is nearest.
// Slower than Newton's method, but it finds them without a start, and beside singular points.
std::optional<dvec2> search_direction(const Net& net, const dvec3& n);

}  // namespace rondure
