// Leaves: pieces of a patch small enough for Newton's method to be safe from a good start.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/bezier/box.h"
#include "renderer/intersect/cell.h"
#include "renderer/intersect/root.h"

namespace rondure {

// Bounds on derivatives hold over the leaf enlarged by this factor about its centre: a root that is found
// there is the only one, even where the search overshoots the leaf.
inline constexpr double leaf_enlargement = 1.35;

// How a leaf looks in its own frame (xi, eta, zeta): the affine one in which the surface, at the leaf's
// centre, is (a, b, 0) to first order, a and b being the leaf's parameters (cell.h) less their values at the
// centre.
//
// With N and w the homogeneous polynomials of the surface in that frame, w = 1 at the centre, a ray of slope
// s = d(xi, eta) / d(zeta) that meets zeta = 0 in p0 meets the surface where
//     N_xieta - s N_zeta - p0 w = 0. (1)
// All bounds are infinite where the surface has no normal at the centre.
struct LeafFrame {
  dvec2 across[4];  // (xi, eta) = across[0] x + across[1] y + across[2] z + across[3]
  dvec4 normal;     // zeta = normal . (x, y, z, 1), in units of the leaf's size

  // Over the leaf, |N_xieta - (a, b)| componentwise, |N_zeta - middle_zeta| and |w - 1|, with room for
  // rounding.
  float bound[2], bound_zeta, bound_weight, middle_zeta;
  // Over the enlarged leaf: the larger row sum of |d N_xieta - I|, the row sum of |d w|, and |d N_zeta|.
  float slack, slack_weight, slack_zeta[2];

  // The surface to second order: zeta = bend (xi^2, xi eta, eta^2), and (a, b) = (xi, eta) - turn (...).
  float bend[3];
  float turn[3][2];
  float bound_bend;  // over the leaf, |zeta - bend (...)|, with room for rounding
};

struct Leaf {
  LeafFrame frame;
  // (u, v) = corner + a edge_a + b edge_b, on rectangles and triangles alike.
  dvec2 corner, edge_a, edge_b;
  NetScale scale;  // bounds sum |P_ij| B_ij over the leaf: what evaluation errors are relative to
  std::int32_t patch = 0;

  dvec2 to_patch(dvec2 p) const { return corner + p.x * edge_a + p.y * edge_b; }
};

inline RectangleCell rectangle_of(const Leaf& leaf) {
  return {leaf.corner, leaf.corner + leaf.edge_a + leaf.edge_b};
}
inline TriangleCell triangle_of(const Leaf& leaf) {
  return {{leaf.corner + leaf.edge_a, leaf.corner + leaf.edge_b, leaf.corner}};
}

struct LeafSet {
  std::vector<Leaf> leaves;
  std::vector<Box> boxes;  // one a leaf, in the surface's frame; contain the leaf's control points
};

// Divides every patch until its leaves are nearly linear as seen along their own normal, or, beside singular
// points, for `max_depth` halvings, and beside places of little weight some more; what is not tame then goes
// to `clipping`, slower and just as right.
// Throws std::runtime_error, naming the patch, when a net is not finite, is of too high a degree, has no
// area, has weights that stay of both signs (or zero) under subdivision, or next to none at a corner. Patches
// k with without[k] get no leaves.
LeafSet build_leaves(const std::vector<Net>& patches, int max_depth, const std::vector<bool>& without = {});

}  // namespace rondure
