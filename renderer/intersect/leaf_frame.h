// A leaf's own frame, and the bounds that hold in it.
#pragma once

#include <limits>

#include "renderer/intersect/leaf_arithmetic.h"

namespace rondure {

// How evenly a leaf runs through its frame: bounds (newton.h) for a ray along its normal, and for the worst
// ray at 45 degrees to it. Infinite where the surface has no normal at the centre.
struct Evenness {
  double straight = std::numeric_limits<double>::infinity();
  double oblique = std::numeric_limits<double>::infinity();
};

// Sets the frame of a leaf that is placed already. `center`: the patch's homogeneous polynomial with its
// derivatives by (u, v) at the leaf's centre. `points`: the leaf's net, of positive weights; `wide`: that of
// the enlarged leaf.
template <class Shape>
Evenness set_frame(const Shape& shape, const LeafArithmetic<Shape>& arithmetic,
                   const LeafParameters& parameters, const SecondOrder<dvec4>& center, const dvec4* points,
                   const dvec4* wide, Leaf& leaf);

}  // namespace rondure
