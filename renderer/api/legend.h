// What the colours of a picture stand for.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// Whether colours can be spread from `low` to `high`: both finite, and as far apart, and positive where
// logarithmic.
inline bool is_scale(double low, double high, bool logarithmic) {
  return low < high && (logarithmic ? low > 0.0 && std::isfinite(high / low) : std::isfinite(high - low));
}

struct Legend {
  std::string title;  // what is shown, and its unit
  double low = 0.0, high = 1.0;
  bool logarithmic = false;
  std::vector<dvec3> colors;  // linear RGB, evenly spaced from low to high
};

}  // namespace rondure
