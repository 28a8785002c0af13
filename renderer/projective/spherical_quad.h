// Four points of the unit sphere joined by circular arcs, and what stereographic projection makes of them.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "renderer/projective/sphere_arc.h"

namespace rondure {

// Counter-clockwise seen from outside; arc[k] runs from corner k to corner k + 1 (mod 4).
struct SphericalQuad {
  std::array<SphereArc, 4> arc;

  const lvec3& corner(int k) const { return arc[static_cast<std::size_t>(k)].p; }
};

// The quad whose sides are great circles.
SphericalQuad geodesic_quad(const std::array<lvec3, 4>& corners);

// Angles in degrees.
struct QuadShape {
  // Interior, in [0, 360): the same on the sphere and in the plane, as stereographic projection keeps angles.
  std::array<long double, 4> angle;
  // By how much the plane image of an arc turns: 0 for a straight line, positive when it is convex.
  std::array<long double, 4> bend;
  // 1 + cos of the angles from the centre to the corners: 0 where one projects from.
  std::array<long double, 4> weight;
};

QuadShape shape_of(const SphericalQuad& quad, const lvec3& centre);

struct QuadDefect {
  enum class Part { corner, arc, whole } part;
  std::size_t index;  // of the corner or arc
  std::string text;   // names it, and its angle
};

// Why the plane image about this centre is not a convex quadrilateral; nothing when it is. Convex means:
// corners and arcs of less than 180 degrees, no arc that bends inward, one turn in all. Cobb (1988, section
// 7) asks for the corners alone, which is not enough. `straight_corners` admits corners of 180 degrees, at
// which the patch is singular.
std::optional<QuadDefect> defect_of(const QuadShape& shape, bool straight_corners);

// The point of the sphere about which the projection is best: the least of the margins (of the corners from
// the point opposite, of that point from the circles within whose region-side caps it must not lie) is
// greatest. Of unit length.
lvec3 best_centre(const SphericalQuad& quad);

}  // namespace rondure
