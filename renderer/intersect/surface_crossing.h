// A root on a patch made into a crossing of the ray.
#pragma once

#include <glm/geometric.hpp>

#include "renderer/bezier/normal.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/crossing.h"
#include "renderer/intersect/leaf.h"
#include "renderer/intersect/settle.h"

namespace rondure {

// `s`: the patch at the root. `point` receives the place in the surface's frame.
inline Crossing cross_surface(const Leaf& leaf, const Net& net, const LocalRay& ray, const Root& root,
                              const FirstOrder<dvec4>& s, dvec3& point) {
  const double inverse = 1.0 / s.value.w;
  point = dvec3(s.value) / s.value.w;
  const dvec3 xu = dvec3(s.du) - point * s.du.w, xv = dvec3(s.dv) - point * s.dv.w;
  dvec3 across = glm::cross(xu, xv);
  // Beside a singular point the cross product is rounding noise; the way the ray crosses is not. (Squares
  // that leave the range of doubles end here too.)
  if (!(glm::dot(across, across) > 1e-12 * glm::dot(xu, xu) * glm::dot(xv, xv)))
    across = unit_normal(net, root.u, root.v, s);
  // The parameters' own resolution counts too, as it does in `settle`.
  const double step = unit_roundoff * (largest(xu) + largest(xv)) * inverse;
  Crossing c = make_crossing(ray, point, across, settled_bound(leaf.scale, ray) * inverse + step,
                             leaf.scale.position * inverse, root.tangent);
  move_to_tangent_plane(c, ray, point, across, step);
  return c;
}

}  // namespace rondure
