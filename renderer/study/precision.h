// The study of single against double precision: what `rondure study precision` does.
#pragma once

#include "renderer/api/registry.h"
#include "renderer/study/study_options.h"

namespace rondure {

// Writes precision.csv and index.html. For spheres of radius r whose centre is a distance d from the world's
// origin: what single precision all through (renderer/study/float_solver.h, Su x Sv) makes of rays, and what
// the tracer does. Columns: family, radius, distance, rays,
// float_hits, float_sphere, float_ray, float_normal, double_hits, double_sphere, double_ray, double_normal:
// the largest distances of a hit from the sphere and from its ray in radii, and the largest angle of the
// normal to the one at the hit's parameters, radians.
void study_precision(const StudyOptions& options, const Registry& registry);

}  // namespace rondure
