// What a patch solver finds: parameters, and how far rounding may have moved them.
#pragma once

#include "renderer/api/patch.h"
#include "renderer/intersect/local_ray.h"

namespace rondure {

// Half an ulp of 1: the relative error of one rounded operation.
inline constexpr double unit_roundoff = 0x1p-53;

// Bound on the error of plane . S(u, v), divided by the sum of |P_ij.xyz| B_ij + |base| |P_ij.w| B_ij there.
//
// Counted in units of roundoff: 1 for the rounded net, 2 for the plane normals being across d only to
// rounding (|s| <= 2 radii), 2 for the plane's distance, 3 for the dot product of four terms, and, since
// Bernstein sums are convex combinations, at most 4 more for their evaluation in the interior of the patch.
inline constexpr double residual_roundoffs = 12.0;

// Bounds of |xyz| and |w| (each as the largest component) that rounding errors are relative to.
struct NetScale {
  double position = 0.0;
  double weight = 0.0;
};

inline double residual_bound(const NetScale& scale, const LocalRay& ray) {
  return residual_roundoffs * unit_roundoff * (scale.position + largest(ray.base) * scale.weight);
}

struct Root {
  double u = 0.0;
  double v = 0.0;
  bool tangent = false;  // tangential or singular within rounding: good to half the digits only
};

}  // namespace rondure
