// A root on a patch made into a crossing of the ray.
#pragma once

#include <glm/geometric.hpp>

#include "renderer/bezier/quotient.h"
#include "renderer/bezier/rational.h"
#include "renderer/bezier/regular_normal.h"
#include "renderer/intersect/crossing.h"
#include "renderer/intersect/leaf.h"
#include "renderer/intersect/settle.h"

namespace rondure {

// The radius of curvature that a ray sees that grazes a patch of size `extent`, if that is larger; not so
// large that rounding by `error` moves the root by more than some sizes. For most patches their size is a
// bound, but flat ones, and others in some directions, do not leave the ray quadratically.
inline double radius_along(const Net& net, const Root& root, const dvec3& direction, double extent,
                           double error) {
  const SurfaceJet jet = surface_jet(net, root.u, root.v);
  const double uu = glm::dot(jet.du, jet.du), uv = glm::dot(jet.du, jet.dv), vv = glm::dot(jet.dv, jet.dv);
  const double du = glm::dot(jet.du, direction), dv = glm::dot(jet.dv, direction), det = uu * vv - uv * uv;
  // At a singular point, and on a flat patch, divisors are zero; what comes of it is never above `extent`, or
  // infinite and then cut to `most`.
  const double a = quotient(vv * du - uv * dv, det), b = quotient(uu * dv - uv * du, det);
  const dvec3 bend = a * a * jet.duu + 2.0 * a * b * jet.duv + b * b * jet.dvv;
  const double out = quotient(glm::dot(bend, glm::cross(jet.du, jet.dv)), std::sqrt(det));
  const double radius = quotient(glm::dot(direction, direction), std::fabs(out));
  const double most = 8.0 * extent * extent / error;
  return radius > extent ? std::fmin(radius, most) : extent;
}

struct SurfaceCrossing {
  Crossing crossing;
  dvec3 point;   // in the surface's frame
  dvec3 normal;  // what unit_normal says
};

// `s`: the patch at the root. `noise`: a bound on normal_noise (regular_normal.h) everywhere on the patch,
// for tangents that are measured by their largest components.
inline SurfaceCrossing cross_surface(const Leaf& leaf, const Net& net, double noise, const LocalRay& ray,
                                     const Root& root, const FirstOrder<dvec4>& s) {
  SurfaceCrossing out;
  const double inverse = 1.0 / s.value.w;
  const dvec3 point = out.point = dvec3(s.value) / s.value.w;
  const dvec3 xu = dvec3(s.du) - point * s.du.w, xv = dvec3(s.dv) - point * s.dv.w;
  const double tangents = largest(xu) + largest(xv);
  dvec3 across = glm::cross(xu, xv);
  double across2 = glm::dot(across, across);
  const double length = std::sqrt(across2);
  if (across2 > 1e-12 * glm::dot(xu, xu) * glm::dot(xv, xv) && is_regular_normal(noise, tangents, length)) {
    out.normal = across / length;
  } else {
    // Beside a singular point the cross product is rounding noise; the way the ray crosses, and how steeply,
    // is not. (Squares that leave the range of doubles end here too.)
    out.normal = across = unit_normal(net, root.u, root.v, s);
    across2 = glm::dot(across, across);
  }
  // The parameters' own resolution counts too, as it does in `settle`.
  const double step = unit_roundoff * tangents * inverse;
  const double error = settled_bound(leaf.scale, ray) * inverse + step;
  double extent = leaf.scale.position * inverse;
  const double along = glm::dot(across, ray.direction);
  if (2.0 * extent * along * along < error * across2 * ray.length2)
    extent = radius_along(net, root, ray.direction, extent, error);
  out.crossing = make_crossing(ray, point, across, error, extent, root.tangent);
  move_to_tangent_plane(out.crossing, ray, point, across, step);
  return out;
}

}  // namespace rondure
