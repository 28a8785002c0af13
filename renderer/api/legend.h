// What the colours of a picture stand for.
#pragma once

#include <string>
#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

struct Legend {
  std::string title;  // what is shown, and its unit
  double low = 0.0, high = 1.0;
  bool logarithmic = false;
  std::vector<dvec3> colors;  // linear RGB, evenly spaced from low to high
};

}  // namespace rondure
