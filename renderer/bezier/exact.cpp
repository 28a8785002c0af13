#include "renderer/bezier/exact.h"

#include <cmath>
#include <cstdint>

namespace rondure {

// Boost's own conversion makes GCC 12 warn of memory that it does use only when set.
Exact exact_of(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const Integer mantissa = static_cast<std::int64_t>(std::ldexp(fraction, 53));
  exponent -= 53;
  const Integer power = Integer(1) << std::abs(exponent);
  return exponent >= 0 ? Exact(mantissa * power) : Exact(mantissa, power);
}

Integer exact_binomial(int n, int k) {
  Integer c = 1;
  for (int i = 0; i < k; ++i) c = c * (n - i) / (i + 1);
  return c;
}

}  // namespace rondure
