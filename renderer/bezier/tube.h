// Exact round tubes along straight lines and circular arcs, for drawing control polygons and boundaries.
#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// The cylinder of this radius about the segment, open at its ends: three patches of degree (2, 1), normals
// outward. None where the ends coincide.
std::vector<TensorNet> straight_tube(const dvec3& from, const dvec3& to, double radius);

// The torus of this radius about the shorter great-circle arc between two directions, on the unit sphere,
// open at its ends: patches of degree (2, 2), normals outward. None where the directions are parallel.
std::vector<TensorNet> arc_tube(const dvec3& from, const dvec3& to, double radius);

}  // namespace rondure
