// Proof in exact arithmetic that patches are regular, or that they are not.
#pragma once

#include "renderer/continuity/regularity.h"

namespace rondure {

// A zero of the normal that is proved to exist, at most `within` away from (u, v) in either parameter.
struct ProvedZero {
  SingularPoint at;
  double within = 0.0;
};

struct ExactRegularity {
  Regularity::Verdict verdict = Regularity::Verdict::undecided;
  int collapsed = 0;   // patches with linear factors of N, which are divided out: then `least` is not known
  double least = 0.0;  // |Su x Sv| is proved to be at least this; rounded down
  long pieces = 0;     // into which the patches were cut
  int deepest = 0;     // halvings of a piece
  std::vector<ProvedZero> singular;
  // Centres of pieces, or places that were found by regularity_of, where nothing is proved: some of them.
  std::vector<SingularPoint> undecided;
  bool spent = false;  // the work ran out
};

// Nets in double precision are rational numbers, so that nothing need be rounded. The normal N of
// renderer/bezier/normal.h is a Bernstein polynomial; where the coefficients of <a, N> are positive on a
// piece for one vector a of integers, N has no zero there, and pieces are halved, at most 120 times, until
// such a vector is found for each and bounds |Su x Sv| by half of the least value found. Zeros that `rounded`
// found are proved by renderer/continuity/exact_zero.h. `most_work` counts sums of two 64-bit words; 10^9 of
// them take some 10 seconds.
ExactRegularity exact_regularity(const Surface& surface, const Regularity& rounded, double most_work = 1e9);

}  // namespace rondure
