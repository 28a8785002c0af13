// Rays and hits, in double precision and world space.
#pragma once

#include <limits>

#include "renderer/api/patch.h"

namespace rondure {

class PassedWalls;

// Where a secondary ray starts: on `surface`, with the outward normal there. The root at t = 0 is left out by
// its own error bound and its crossing direction, never by an offset in world units.
struct RayStart {
  int surface = -1;  // -1: the ray starts in free space
  dvec3 normal{0.0};
  const PassedWalls* passed = nullptr;  // by the path before, in the same place; outlives the ray
};

// Points o + t d with t in [t_min, t_max]; the direction is taken as given, of any length.
struct Ray {
  dvec3 origin{0.0};
  dvec3 direction{0.0, 0.0, 1.0};
  double t_min = 0.0;
  double t_max = std::numeric_limits<double>::infinity();
  RayStart start{};
};

struct Hit {
  double t = std::numeric_limits<double>::infinity();
  double t_error = 0.0;  // bound on |t - exact root|, from the solver's residual and conditioning
  int surface = -1;      // index of the object in the scene; -1: no hit
  int patch = -1;        // index of the patch in its surface (0 for an analytic surface)
  double u = 0.0;
  double v = 0.0;
  dvec3 point{0.0};   // evaluated on the surface, not along the ray
  dvec3 normal{0.0};  // unit, d/du x d/dv or its limit: outward on closed surfaces

  explicit operator bool() const { return surface >= 0; }
};

}  // namespace rondure
