// The differential surface that belongs to the octahedron: its charts and transition maps (Vidunas 2005,
// section 4). Functions are differentiable in the charts exactly where they are geometrically continuous on
// the complex (Theorem 4.2).
#pragma once

#include <glm/mat2x2.hpp>

#include "renderer/api/patch.h"

namespace rondure {

// A point of the surface: octant 0 to 7 as in octahedron_complex, and barycentric coordinates in it.
struct OctantPoint {
  int octant = 0;
  dvec3 barycentric{0.0};
};

// The fractional-linear map from octant i's plane to octant j's (equations 4.3 to 4.5, and their composites
// for octants that share a vertex only): coordinates on whose axes the octants differ change sign, and the
// sum is made 1 again. Infinite where that sum is 0.
dvec3 transition(int i, int j, const dvec3& barycentric);

// A chart lives in the plane of one octant's triangle: its inside, the neighbourhood of an edge or that of a
// corner (0, 1, 2 are P, Q, R; edge k runs from corner k to the next).
struct OctantChart {
  enum class Kind { inside, edge, corner };
  Kind kind = Kind::inside;
  int octant = 0;
  int part = 0;  // the edge or the corner
};

// Whether the point of the plane lies in the chart's open set V_p: the triangle's inside, w^2 < u v beside
// the edge w = 0, v^2 + w^2 < u^2 / 9 about the corner u = 1.
bool in_chart(const OctantChart& chart, const dvec3& barycentric);

// phi_p: where that point lies on the surface. Coordinates below 0 lead to the neighbours.
OctantPoint chart_point(const OctantChart& chart, const dvec3& barycentric);

// phi_p's inverse; the point must lie in the chart's image.
dvec3 chart_coordinates(const OctantChart& chart, const OctantPoint& point);

// The derivative of `transition` at a point, for (u, v) with w = 1 - u - v on both sides: column 0 is d/du.
glm::dmat2 transition_derivative(int i, int j, const dvec3& barycentric);

}  // namespace rondure
