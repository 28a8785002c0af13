// A leaf's own frame, and the bounds that hold in it.
#pragma once

#include <span>

#include "renderer/intersect/leaf.h"

namespace rondure {

// How evenly a leaf runs through its frame: bounds (newton.h) for a ray along its normal, and for the worst
// ray at 45 degrees to it. Infinite where the surface has no normal at the centre.
struct Evenness {
  double straight = std::numeric_limits<double>::infinity();
  double oblique = std::numeric_limits<double>::infinity();
};

// Sets the frame of a leaf that is placed already. `center`: the patch's homogeneous polynomial with its
// derivatives by (u, v) at the leaf's centre. `points`: the leaf's net, of positive weights; `wide`: that of
// the enlarged leaf, which is overwritten.
Evenness set_frame(const TensorShape& shape, const SecondOrder<dvec4>& center, std::span<const dvec4> points,
                   std::span<dvec4> wide, Leaf& leaf);
Evenness set_frame(const TriangleShape& shape, const SecondOrder<dvec4>& center,
                   std::span<const dvec4> points, std::span<dvec4> wide, Leaf& leaf);

}  // namespace rondure
