// Circular arcs on the unit sphere as rational quadratic curves, without trigonometry.
#pragma once

#include "renderer/projective/extended.h"

namespace rondure {

// From p to q, control points (p, 1), (b, w), (q, 1), homogeneous: of all rational quadratic
// parametrisations the symmetric one. w is the cosine of half the arc, negative when that is over 180
// degrees; b / w is where the tangents at p and q meet.
struct SphereArc {
  lvec3 p, q, b;
  long double w;

  // Tangents at the ends, along the arc, of length 1.
  lvec3 start_tangent() const;
  lvec3 end_tangent() const;
};

// All points on the unit sphere, no two of an arc the same.

// The shorter arc of the great circle; p + q must not be zero.
SphereArc great_arc(const lvec3& p, const lvec3& q);

// The arc that passes through r on its way.
SphereArc arc_through(const lvec3& p, const lvec3& r, const lvec3& q);

// The middle of the shorter arc from p to q in the plane normal . x = distance, |normal| = 1, which must
// contain both; they must not be opposite on that circle.
lvec3 middle_in_plane(const lvec3& p, const lvec3& q, const lvec3& normal, long double distance);

}  // namespace rondure
