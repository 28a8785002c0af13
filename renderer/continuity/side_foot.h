// Points of a patch's side, and the one of them that is nearest to another point.
#pragma once

#include "renderer/continuity/seams.h"

namespace rondure {

dvec3 point_on_side(const Net& net, int side, double t);

struct SideFoot {
  double t = 0.0;
  double distance = 0.0;
};

// The parameter where the side comes nearest to p: from `guess`, or the best of some equal steps if that is
// nearer, by Gauss's and Newton's method, each step halved until it gains. A guess that rounding alone could
// better is kept.
SideFoot foot_on_side(const Net& net, int side, const dvec3& p, double guess);

}  // namespace rondure
