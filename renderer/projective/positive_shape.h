// The search for a member of a family of preimages whose image has positive weights only.
#pragma once

#include "renderer/projective/shaped_preimage.h"

namespace rondure {

// How far ratios are sought: from 1 / widest_ratio to widest_ratio.
inline constexpr double widest_ratio = 64;

struct PositiveShape {
  enum class Outcome {
    found,
    none,      // bounds on the weights exclude all shapes with these ratios
    undecided  // the number of boxes looked at came to its limit
  } outcome = Outcome::none;
  Shape shape;       // where found
  double least = 0;  // its least weight, each in units of the corners' geometric mean for its place
  std::size_t boxes = 0;
};

// A regular member with positive weights, by branch and bound. Weights are sums of products of powers and
// cosines, which can be bounded over boxes of shapes; boxes where one weight is nowhere positive are dropped,
// those with the highest bound divided first. Where there is one, ratios up to 2, then 4, and so on are
// searched again, each for some time, and the first of these ranges that has any gives it: the shape of the
// greatest least weight, or one of half of that. The same family gives the same shape always.
PositiveShape positive_shape(const PreimageFamily& family);

}  // namespace rondure
