// Error-free transformations: a rounded result and the exact error that it left behind.
// Source: Dekker 1971 and Knuth (TAOCP 2, 4.2.2); the product uses a fused multiply-add (Ogita, Rump, Oishi
// 2005).
#pragma once

#include <cmath>

namespace rondure {

// high + low is the exact value, unless an intermediate overflows.
struct TwoFold {
  double high = 0.0;
  double low = 0.0;
};

inline TwoFold two_sum(double a, double b) {
  const double sum = a + b;
  const double from_b = sum - a;
  return {sum, (a - (sum - from_b)) + (b - from_b)};
}

inline TwoFold two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

}  // namespace rondure
