// A root made into a place on the ray: its t, how exact that is, and which way the ray crosses.
#pragma once

#include "renderer/bezier/quotient.h"
#include "renderer/intersect/local_ray.h"

namespace rondure {

struct Crossing {
  double s = 0.0;        // t in the local ray's units, from its base
  double s_error = 0.0;  // bound on the error of `s`
  double extent = 0.0;   // size of the surface, as its radius of curvature where that matters
  int sign = 0;          // of direction . normal: -1 entering, +1 leaving, 0 when rounding cannot tell
  int likely = 0;        // the same, as it was computed
};

// `point` and the unnormalised `normal` in the surface's frame; `error`: how far, at right angles to the ray,
// the point may be off; `extent`: the size of the surface, as its radius of curvature where it matters.
//
// A root moves along the ray by error / cos(theta), cos(theta) being |normal . direction| over both lengths;
// near tangency the ray leaves the surface quadratically, which bounds the same shift by sqrt(2 error
// extent).
inline Crossing make_crossing(const LocalRay& ray, const dvec3& point, const dvec3& normal, double error,
                              double extent, bool tangent) {
  Crossing c;
  c.s = glm::dot(point - ray.base, ray.direction) * ray.inverse_length2;
  const double along = glm::dot(normal, ray.direction);
  const double straight = quotient(error * glm::length(normal), std::fabs(along));
  const double quadratic = std::sqrt(2.0 * error * extent * ray.inverse_length2);
  const double shift = straight < quadratic ? straight : quadratic;  // also where the normal vanishes
  c.s_error = 2.0 * shift + 0x1p-52 * std::fabs(ray.slide + c.s);
  c.extent = extent;
  c.likely = along > 0.0 ? 1 : along < 0.0 ? -1 : 0;
  c.sign = tangent ? 0 : c.likely;
  return c;
}

// Where a double's step in the parameters moves the point by more than its rounding (`resolution`), it is
// still on the surface, but beside the ray: the ray's place is then in the tangent plane, not at the foot of
// the point. Elsewhere the normal, which may be beside a singular point, has nothing to mend.
inline void move_to_tangent_plane(Crossing& c, const LocalRay& ray, const dvec3& point, const dvec3& normal,
                                  double resolution) {
  if (!(resolution > 0x1p-50 * (largest(point) + largest(ray.base)))) return;
  const dvec3 beside = point - ray.base - c.s * ray.direction;
  const double slide = quotient(glm::dot(normal, beside), glm::dot(normal, ray.direction));
  if (std::fabs(slide) <= c.s_error) c.s += slide;
}

// Whether a crossing of `surface` is a hit of the ray, whose local form is `local`; `t` receives its place on
// the ray.
//
// A ray that starts on a surface meets that surface at t = 0, to rounding, by construction. That root, and no
// other, is left out: it is the one whose t is 0 within the error bounds and whose crossing goes the same way
// as the ray leaves. A second root however near (the far wall of a sphere met at a grazing angle) crosses the
// other way and counts.
inline bool accept(const Ray& ray, const LocalRay& local, int surface, const dvec3& frame, const Crossing& c,
                   double& t) {
  t = (local.slide + c.s) * local.scale;
  if (ray.start.surface == surface) {
    // The start is a rounded world position: it is off by an ulp of itself, along the normal too.
    const double moved = 0x1p-52 * (largest(ray.origin) + largest(frame)), length = std::sqrt(local.length2);
    const double leaving = glm::dot(ray.start.normal, local.direction), cosine = std::fabs(leaving) / length;
    const double quadratic = 2.0 * std::sqrt(2.0 * moved * c.extent);
    const double shift = moved < quadratic * cosine ? moved / cosine : quadratic;
    const double bound = (c.s_error + 2.0 * shift / length) * local.scale;
    const int side = leaving > 0.0 ? 1 : -1;
    if (std::fabs(t) <= bound) {
      if (c.sign == side || c.sign == 0) return false;
      // Going in, the far wall is ahead, even where rounding puts it at or behind the start.
      if (side < 0) t = std::fmax(t, 0.0);
    }
  }
  return t >= ray.t_min && t <= ray.t_max;
}

}  // namespace rondure
