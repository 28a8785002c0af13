// Which patches of a surface lie on one sphere or ellipsoid: found from their nets alone.
#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// center + linear . (unit sphere), in the surface's frame.
struct EllipsoidFit {
  dmat3 linear{1.0};
  dvec3 center{0.0};
  double off = 0.0;                  // bound on how far its patches are from it, relative to the semi-axes
  std::vector<std::size_t> patches;  // those on it, in order
};

// The ellipsoids that patches lie on, each with all of its patches; a patch is in one of them at most. A
// patch lies on one when the identity |x|^2 = w^2 of the net's image in the unit sphere's space holds
// coefficient by coefficient, to the rounding of the net (`ellipsoid_roundoffs`). Nets with weights that are
// not positive, or that see too little of an ellipsoid to tell which, are in none.
std::vector<EllipsoidFit> fit_ellipsoids(const std::vector<Net>& patches);

// Bound on |x|^2 / w^2 - 1 over an accepted patch, in units of roundoff times 1 + (distance of the frame's
// zero from the center, in semi-axes), as coordinates are rounded at their own size: how far the patch is
// from the ellipsoid is half as much, relative to the semi-axes. A net rounded to doubles has 2 or 3 of its
// own on each of two factors, times |P| / w of its control points, which are not much more than 1 on most
// patches; turning or stretching it rounds as often again, and the matrix that did so. (Of hemispheres, one
// turn of 60 is refused, with 37.)
inline constexpr double ellipsoid_roundoffs = 24.0;

}  // namespace rondure
