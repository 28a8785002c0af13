// The spacing of numbers at 1, twice the unit roundoff; and infinity.
#pragma once

#include <limits>

namespace rondure {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr double long_epsilon = static_cast<double>(std::numeric_limits<long double>::epsilon());
inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace rondure
