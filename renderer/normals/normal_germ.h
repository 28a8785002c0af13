// What the normal of a patch does about one point of its domain.
#pragma once

#include "renderer/api/patch.h"

namespace rondure {

struct NormalGerm {
  // Order of the zero of Su x Sv there: 0 at a regular point. Along a collapsed side the order with which the
  // side's parameter divides it is `side_order`, and `order` is that of what is left.
  int order = 0;
  int side_order = 0;
  // Whether the unit normal has one limit from all ways inside the domain; on a collapsed side, all ways to
  // the same parameter of the side.
  bool has_limit = true;
  // By how much the normals of ways in that are not tangent to each other differ as they arrive, radians.
  double spread = 0.0;
};

// From the normal polynomial without the factors of its sides (renderer/bezier/edge_factor.h): at a corner
// its coefficients tell the order and every limit, without cancellation; elsewhere it is followed inward
// along nine ways.
NormalGerm germ_of(const Net& net, dvec2 at);

}  // namespace rondure
