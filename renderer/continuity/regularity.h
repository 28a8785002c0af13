// Whether the patches of a surface are regular: whether |Su x Sv| is above 0 everywhere, with proof.
#pragma once

#include <vector>

#include "renderer/api/surface.h"

namespace rondure {

struct SingularPoint {
  // What is proved, whatever rounding did to the control points and since. exact: N vanishes at this corner
  // of the patch, as far as rounding lets control points tell, and nowhere else near it. unique: at one place
  // within `within` of these parameters, and nowhere else near it. none: N is found to be zero up to
  // rounding.
  enum class Proof { none, exact, unique };

  int patch = 0;
  double u = 0.0, v = 0.0;
  dvec3 point{0.0};
  Proof proof = Proof::none;
  double within = 0.0;
};

struct Regularity {
  enum class Verdict { regular, singular, undecided };
  Verdict verdict = Verdict::undecided;
  // Sides along which every normal vanishes (they are points or run into cusps); the rest is judged without
  // the factors that belong to them, and `least` is then not known.
  int collapsed = 0;
  double least = 0.0;        // |Su x Sv| is proved to be at least this
  double least_found = 0.0;  // and takes this value
  double largest_found = 0.0;
  SingularPoint least_at;               // where it takes it
  std::vector<SingularPoint> singular;  // some of them, where there are many
  // All other places are proved to be regular, but for collapsed sides.
  bool complete = false;
  bool spent = false;  // the budget ran out
  long pieces = 0;     // into which the patches were cut
};

// From the Bernstein coefficients of the normal polynomial N: on a piece of a patch all of them lie on one
// side of a plane through 0, further away than what rounding can have changed; pieces are halved until they
// do. `least` is then at least half of `least_found`. A piece at a corner may have zeros among them that
// vanish there alone, and one near a simple zero inside is settled by Kantorovich's theorem; pieces that
// shrink to 2^-30 of a patch without a proof are searched for zeros. At most `budget` pieces, fewer of high
// degree: their work counts.
Regularity regularity_of(const Surface& surface, long budget = 200000);

}  // namespace rondure
