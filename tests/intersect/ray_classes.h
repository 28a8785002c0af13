// Rays aimed where solvers lose them.
#pragma once

#include <random>

#include "tests/intersect/closed_models.h"

namespace rondure {

enum class RayClass {
  random_outside,
  random_inside,
  shared_edge,  // at a point of a patch's boundary
  corner,  // at a patch's corner: vertices, singular corners, collapsed edges; or past it by 10^-1 to 10^-17
  parameter_line,  // at a point with u or v in {0, 1/2, 1}
  tangential,      // at impact R (1 +- 10^-1 ... 10^-16), R the distance of a tangent plane
  from_surface,    // starting on the surface
  far_away,        // from 10^8 radii
  very_near,       // from 10^-8 radii off the surface, or off the middle
  axis_aligned,    // along an axis, half of them through symmetry planes
  edge_plane,      // in the plane of a patch's boundary curve, along the surface or not
  extreme_length,  // as the first six, with directions of 2^1000 down to denormal numbers
  count
};
const char* name_of(RayClass c);

struct AimedRay {
  Ray ray;
  int parity = -1;     // of the number of hits, where it is known: 0 or 1
  double doubt = 0.0;  // t, about the ray's ends, where a hit is rounding's choice
};

AimedRay aim(const ClosedModel& model, RayClass c, std::mt19937_64& random);

}  // namespace rondure
