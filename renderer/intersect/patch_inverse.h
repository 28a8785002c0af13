// From points of the sphere back to parameters: the complex quotient that a patch is, in powers.
#pragma once

#include <optional>

#include "renderer/intersect/sphere_patches.h"

namespace rondure {

// Of a net on the unit sphere, to `rounding` roundoffs, whose middle is near (0, 0, -1). Nothing when its
// degree, halved where that can be, is above 4.
std::optional<PatchInverse> patch_inverse(const Net& net, double rounding);

}  // namespace rondure
