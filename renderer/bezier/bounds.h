// Bounding boxes of rational patches.
#pragma once

#include <optional>

#include "renderer/api/patch.h"
#include "renderer/bezier/box.h"

namespace rondure {

// A box that contains the patch: the hull of the projected control points, which holds while all weights have
// one sign. Where they do not, the patch is subdivided until they do on every piece. Empty when that does not
// come to an end (the weight vanishes on the patch or very nearly so) or a coordinate is not finite.
std::optional<Box> bounds_of(const Net& net);

}  // namespace rondure
