// Control nets as scenes write them: "kind", "degree" and "net", tensor-product or triangular.
#pragma once

#include <string>

#include "renderer/api/params.h"

namespace rondure {

// What a control point is in messages, and what makes a net useless.
struct NetForm {
  const char* point;    // "[w x, w y, w z, w]"
  int highest_degree;   // in each direction; the lowest is 1
  bool weights = true;  // the last coordinate is a weight, and must not always be zero
  bool planar = false;  // points are [x, y] or [w x, w y, w], read as (w x, w y, 0, w)
};

// Reads all that a patch of a list has, "kind" included, and finishes it.
Net read_net(Params& patch, const NetForm& form);

}  // namespace rondure
