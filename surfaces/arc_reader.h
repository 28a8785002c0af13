// Corners on the unit sphere and the circular arcs between them, as scenes write them.
#pragma once

#include <string>
#include <vector>

#include "renderer/api/surface.h"
#include "renderer/projective/sphere_arc.h"

namespace rondure {

// A point of the sphere, given as any vector that points to it.
lvec3 read_direction(const Params& params, const Value& value, const std::string& subject);

// "corners" and "arcs": `count` (3 or 4) arcs, each from a corner to the next. Without "arcs", the shorter
// arcs of great circles.
std::vector<SphereArc> read_arcs(Params& params, std::size_t count);

ParameterDoc arcs_doc(std::size_t count);

}  // namespace rondure
