// Parameter lines drawn on a patch: u and v (on a triangle also 1 - u - v) at multiples of 1 / count.
//
// A line has one width in space, whatever the parametrisation does around it, so that a picture shows how
// parameters run and not how fast.
#pragma once

#include "renderer/api/patch.h"

namespace rondure {

struct Isolines {
  int count = 8;                 // strips between lines, in each parameter
  double width = 0.01;           // of the lines inside the patch, in scene units
  double boundary_width = 0.02;  // of the patch's boundary: half of it lies on this patch
  dvec3 albedo{0.02};            // of the ink, which scatters diffusely
};

// Whether `point`, which is `net` at (u, v), lies on one of the lines. Distances are those to the line's
// nearest point by Gauss-Newton steps along it, so that they hold at singular corners, where a first-order
// estimate from d/du x d/dv would call every line near.
bool on_isoline(const Isolines& lines, const Net& net, const dvec3& point, double u, double v);

}  // namespace rondure
