// Whether a ray meets a patch to within the rounding that solvers allow for: what is left to say of a root on
// a patch's side, where no interval tells in from out.
#pragma once

#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/certified_net.h"
#include "renderer/intersect/ellipsoid_fit.h"
#include "renderer/intersect/settle.h"
#include "renderer/intersect/sphere_solver.h"
#include "renderer/intersect/tracer.h"

namespace rondure {

// How far beside its ray a hit may be, in roundoffs of the patch's size and the ray's base: 23, or 131 on a
// sphere. `settle` allows settled_roundoffs across either of two planes, which are beside the ray by
// residual_roundoffs themselves: sqrt(2) times both. On a sphere it is beside_roundoffs in each of three
// coordinates; and of the sphere's point that they are counted from 8 (ellipsoid_error), and what the sphere
// may be beside the patch.
inline double rounding_beside(Solver solver) {
  return solver == Solver::quadric ? 1.7321 * beside_roundoffs + 8.0 + ellipsoid_roundoffs / 2.0
                                   : 1.4143 * (settled_roundoffs + residual_roundoffs);
}

// Whether the point of the patch at (u, v) is within that of the ray, and half an ulp of each parameter. A
// proof: false where the point is not in the patch, or rounding in T hides where it is.
template <class T>
bool meets_within_rounding(const Net& net, const CertifiedPiece<T>& whole, const CertifiedRay<T>& ray,
                           Solver solver, dvec2 at) {
  if (!(whole.outside(at) <= 0.0)) return false;
  const T distance = ray.distance(whole.value(at), whole.value_error());
  const auto length = [](const dvec3& x) { return std::hypot(x.x, x.y, x.z); };
  double size = 0.0, weight = 0.0;
  for (const dvec4& p : points_of(net))
    size = std::max(size, length(dvec3(p))), weight = std::max(weight, std::fabs(p.w));
  const double base = static_cast<double>(std::hypot(ray.base()[0], ray.base()[1], ray.base()[2]));
  const FirstOrder<dvec4> s = net_first(net, at.x, at.y);
  const dvec3 point = dvec3(s.value) / s.value.w;
  const double steps = length(dvec3(s.du) - s.du.w * point) + length(dvec3(s.dv) - s.dv.w * point);
  const double bound = unit_roundoff * (rounding_beside(solver) * (size + base * weight) + 1.7321 * steps);
  return std::ldexp(distance, whole.units.position) <= static_cast<T>(bound);
}

}  // namespace rondure
