// A ball in patches, for the ends of tubes and for control points.
#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// Six patches of degree (2, 4), normals outward.
std::vector<TensorNet> ball(const dvec3& centre, double radius);

}  // namespace rondure
