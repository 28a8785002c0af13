// Closed-form intersection with the image of the unit sphere under a linear map: the surface that exact
// patches are compared with.
#pragma once

#include <optional>

#include "renderer/intersect/root.h"

namespace rondure {

struct Ellipsoid {
  dmat3 linear{1.0};  // unit sphere to surface, about the frame's zero
  dmat3 inverse{1.0};
  dmat3 turn{1.0};              // of the unit sphere before that: of its parameters only
  double extent = 1.0;          // bounds the largest semi-axis, as the root of the sum of their squares
  double uniform_radius = 0.0;  // the radius when `linear` is a scaled rotation, else 0

  explicit Ellipsoid(const dmat3& map);  // not too flat
};

// The same ellipsoid as a map of orthogonal columns, after a turn: the rounding of the inverse's entries then
// moves each coordinate by as much as the semi-axis is short, and a point in space by roundoff, however flat
// it is.
Ellipsoid on_principal_axes(const dmat3& map);

// Semi-axes in a greater ratio are too many for the closed form: in the unit sphere's space rounding moves a
// ray by roundoff times the ratio, and its outline by the square of that, relative to the longest axis.
inline constexpr double flattest_ellipsoid = 1e8;
bool is_too_flat(const dmat3& map);

struct EllipsoidHit {
  dvec3 point;   // in the surface's frame
  dvec3 normal;  // unit, outward
};

// What of the ray is inside, in the unit sphere's space: from middle - half to middle + half. Nothing when it
// misses; of no length where it is tangential.
struct EllipsoidPassage {
  dvec3 middle, half;
};
std::optional<EllipsoidPassage> meet_ellipsoid(const Ellipsoid& surface, const LocalRay& ray) noexcept;
// Side -1: where it enters, 1: where it leaves.
EllipsoidHit ellipsoid_hit(const Ellipsoid& surface, const EllipsoidPassage& chord, int side) noexcept;

// Longitude / 2 pi from +x towards +y, and colatitude / pi from +z, of the point's pre-image on the unit
// sphere.
dvec2 ellipsoid_parameters(const Ellipsoid& surface, const dvec3& point) noexcept;

// Bound on the distance of a computed hit from the exact one, at right angles to the ray.
inline double ellipsoid_error(const Ellipsoid& e) { return 8.0 * unit_roundoff * e.extent; }

}  // namespace rondure
