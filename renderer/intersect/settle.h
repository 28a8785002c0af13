// The last word on a root: is it on the patch, and is it on the ray?
//
// Rounding can put a root just outside its patch, or leave it open whether a ray touches or passes, so the
// solvers propose roots a little beyond what they can be sure of. Whether one counts is then a single
// question: does a point of the patch itself lie on the ray, to within the rounding of its control points? A
// root outside is brought to the boundary and slid along it to where the residual is least; the residual is
// summed in extended precision, so that what is left is the rounding of the net (1 roundoff, and 1 more for
// the neighbour's); half an ulp of each parameter comes on top, by the derivatives there. Both
// patches at a seam see the same pair of planes and answer the same question about the same curve: no ray
// passes between them.
#pragma once

#include "renderer/intersect/root.h"

namespace rondure {

// In units of roundoff times the scale of the net.
inline constexpr double settled_roundoffs = 4.0;

inline double settled_bound(const NetScale& scale, const LocalRay& ray) {
  return settled_roundoffs * unit_roundoff * (scale.position + largest(ray.base) * scale.weight);
}

// Moves the root into the patch's domain. False when it is none.
bool settle(const Net& net, const NetScale& scale, const LocalRay& ray, Root& root) noexcept;

}  // namespace rondure
