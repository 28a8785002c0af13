// Proof in exact arithmetic that patches are regular.
#pragma once

#include "renderer/complex/complex_surface.h"

namespace rondure {

struct ExactRegularity {
  bool certified = false;
  long pieces = 0;  // into which the patches were cut
  int deepest = 0;  // halvings of a piece
};

// The normal N of renderer/bezier/normal.h is a Bernstein polynomial. Where the coefficients of <a, N> are
// positive on a piece for one vector a of integers, N has no zero there; pieces are halved until such a
// vector is found for each. Every weight must be positive on the patches. Not certified: some piece still had
// none after `deepest_allowed` halvings, or there are more than `most_pieces`.
ExactRegularity exact_regularity(const std::vector<ExactPatch>& patches, int deepest_allowed = 30,
                                 long most_pieces = 100000);

}  // namespace rondure
