// What the file's floats hold.
#pragma once

#include <algorithm>
#include <limits>

namespace rondure {

// The nearest float of a number; beyond the largest, that. NaN is NaN.
inline float stored(double x) {
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -most, most));
}

}  // namespace rondure
