// Where one surface touches another, which wall comes first is no matter of rounding.
#pragma once

#include "renderer/intersect/crossing.h"
#include "renderer/intersect/query.h"

namespace rondure {

// Where the surface that a crossing is of and the one that the ray starts on touch: on which side of the
// start's wall the crossing's is, that to which the start's normal points or the other. None where they do
// not touch, but cross, or that cannot be told.
struct Contact {
  enum class Side { none, outer, inner } side = Side::none;
  bool alike = false;  // the two normals point the same way
};

// Surfaces that touch have the same normal there, or opposite ones, to within the square root of rounding, or
// what the start's rounding moves it round a surface much smaller: half of the digits of a float.
inline constexpr double contact_angle = 0x1p-10;
// No contact is farther from the start than this, in sizes of the crossing's surface.
inline constexpr double contact_reach = 0x1p-20;

// A surface at a point of it, with the normal that hits have there.
struct Wall {
  unsigned surface;
  dvec3 point, normal;
};

// On which side of the second the first is, where they are at one point. Closed surfaces whose normals are
// opposite are side by side. Of those with one normal the one that bends more is inside, the smaller one
// where that is not known, and the later one of a size. An open surface, which has no inside, is around a
// closed one, and goes with another open one as if both were closed.
Contact contact_of(const PlacedSurface* surfaces, const Wall& wall, const Wall& other);

// How large a surface's coordinates are in its frame: what errors are relative to.
inline double extent_of(const PlacedSurface& surface) {
  const Box& bounds = surface.compiled->bounds;
  return std::max(largest(bounds.low), largest(bounds.high));
}

// And how large the surface itself is.
inline double size_of(const PlacedSurface& surface) {
  return largest(surface.compiled->bounds.high - surface.compiled->bounds.low);
}

// Of errors of a crossing of a surface of `extent`, at a ray's start or hit in `point`: how many the start
// adds where it is rounded, on a surface of `start_extent`. It moves the crossing along the ray as the
// crossing's own error does, which was 2^-50 of the extent at least.
inline double doubt_at(double extent, double start_extent, const dvec3& point, const dvec3& frame) {
  const double moved = 0x1p-51 * start_extent + 0x1p-52 * (largest(point) + largest(frame));
  return 1.0 + 2.0 * moved / (0x1p-50 * extent);
}

// Whether a crossing is where its ray starts, on a surface of `start_extent`, to rounding.
inline bool is_at_start(const Ray& ray, const LocalRay& local, const dvec3& frame, double start_extent,
                        const Crossing& c) {
  const double ahead_by = local.slide + c.s,
               bound = std::fmin(c.s_error * doubt_at(c.extent, start_extent, ray.origin, frame),
                                 contact_reach * c.extent * std::sqrt(local.inverse_length2));
  return std::fabs(ahead_by) <= bound && !(ray.t_min > 0.0 || ray.t_max < 0.0);
}

// Whether a ray that starts on one surface meets another there (is_at_start), where they touch or all but
// touch and rounding may have put the other's wall on either side of the start. The wall is ahead
// where the ray goes on to it through the space between: of surfaces side by side it leaves the one and goes
// into the other; of nested ones it goes from the outer into the inner, or from the inner out of the outer.
// The other way about the ray has come through that wall already. `accepted` and `t`: what `accept` says of
// the crossing, and what this does. `contact()` is asked last.
template <class Ask>
bool accept_at_contact(const Ray& ray, const LocalRay& local, const Crossing& c, bool accepted,
                       const Ask& contact, double& t) {
  if (c.likely == 0) return accepted;
  const double leaving = glm::dot(ray.start.normal, local.direction);
  const bool outward = leaving > -0x1p-50, inward = leaving < 0x1p-50;
  const Contact how = contact();
  if (how.side == Contact::Side::none) return accepted;
  // Along the walls, to rounding, the ray crosses both the same way, whichever that is.
  const bool out_of_both = (c.likely > 0) == how.alike, outer = how.side == Contact::Side::outer;
  const bool to_outer = outward && out_of_both, to_inner = inward && !out_of_both;
  const bool ahead = outer ? to_outer : to_inner, passed = outer ? to_inner : to_outer;
  if (ahead && !accepted) t = 0.0;
  return ahead || (accepted && !passed);
}

}  // namespace rondure
