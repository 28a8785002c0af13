// Leaves: pieces of a patch small enough for Newton's method to be safe from their centre.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "renderer/bezier/box.h"
#include "renderer/intersect/cell.h"
#include "renderer/intersect/root.h"

namespace rondure {

// Spreads hold over the leaf enlarged by this factor, which contains every Newton iterate of a root in the
// leaf.
inline constexpr double leaf_enlargement = 1.35;

// The surface linearised at the leaf's centre, and how far its derivatives stray from that over the enlarged
// leaf. Local parameters (a, b) as in cell.h; (u, v) = corner + a edge_a + b edge_b on rectangles and
// triangles alike.
struct Leaf {
  dvec4 center, da, db;      // S and its derivatives, homogeneous
  dvec4 spread_a, spread_b;  // |dS/da - da| and |dS/db - db|, componentwise
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
// points, for `max_depth` halvings; what is not tame then goes to `clipping`, slower and just as right.
// Throws std::runtime_error, naming the patch, when a net is not finite, is of too high a degree, or has
// weights that stay of both signs (or zero) under subdivision. Patches k with without[k] are
// left out.
LeafSet build_leaves(const std::vector<Net>& patches, int max_depth, const std::vector<bool>& without = {});

}  // namespace rondure
