// How far a patch may be from an ellipsoid: coefficient by coefficient.
#pragma once

#include "renderer/api/patch.h"
#include "renderer/projective/generalised_projection.h"

namespace rondure {

// center + linear . (unit sphere), and how the unit sphere's space is reached from it.
struct EllipsoidMap {
  using Matrix = glm::mat<3, 3, long double, glm::defaultp>;

  EllipsoidMap(const dmat3& linear, const dvec3& center);

  Matrix inverse;
  glm::vec<3, long double, glm::defaultp> center;
  long double distance;  // of the frame's zero from the center, in semi-axes
};

inline constexpr int largest_proven_degree = 8;

// Bound on |x|^2 / w^2 - 1 over the patch, of the net's image in the unit sphere's space. Of degrees up to
// the largest proven one, with positive weights. Infinite where one is less than 2^-18 of the
// greatest coordinate or weight, binomial factors included.
double defect_of(const Net& net, const EllipsoidMap& map);

// Whether some of the net's control points that are points of the patch, its corners, are near: what is far
// away is told so in little time.
bool may_lie_on(const Net& net, const EllipsoidMap& map);

}  // namespace rondure
