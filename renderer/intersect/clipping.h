// Every root of a ray on a rational patch, tangential and singular ones included.
//
// Bezier clipping (Sederberg, Nishita 1990; Nishita, Sederberg, Kakimoto 1990) with subdivision, on the two
// projected polynomials. A cell of the parameter domain is finished as soon as one of these is shown:
//   empty   the Bernstein hull of a polynomial, or of a combination of the two, keeps away from zero;
//   simple  the preconditioned Jacobian stays near the identity over the cell, so that there is one root at
//           most and Newton's method finds it (Krawczyk 1969);
//   fold    one polynomial is a graph over the cell, and the other is convex along it: two roots at most, at
//           either side of the extremum. Tangential rays and singular corners end here, at any distance;
//   point   both polynomials are within a few rounding errors of zero all over the cell.
// Otherwise the cell is clipped, or halved.
#pragma once

#include <limits>
#include <vector>

#include "renderer/intersect/cell.h"
#include "renderer/intersect/root.h"

namespace rondure {

struct SearchCounts {
  std::size_t cells = 0;
  std::size_t exhausted = 0;  // searches given up at a limit: roots may be missing
  std::size_t limit = std::numeric_limits<std::size_t>::max();  // of `cells`, for all searches together
};

// Roots in `cell` of the net `f` (degree from `shape`, coefficients over the whole patch), whose evaluation
// error is below `error`. Root parameters are the patch's own. They are candidates: where rounding leaves it
// open whether there is a root, or on which side of the boundary, it is among them, and `settle` decides. A
// ray that runs inside the surface (a line of a plane or ruled surface) has no isolated root there and none
// is reported.
void find_roots(const TensorShape& shape, const dvec2* f, const RectangleCell& cell, double error,
                std::vector<Root>& roots, SearchCounts& counts) noexcept;
void find_roots(const TriangleShape& shape, const dvec2* f, const TriangleCell& cell, double error,
                std::vector<Root>& roots, SearchCounts& counts) noexcept;

}  // namespace rondure
