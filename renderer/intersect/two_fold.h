// Error-free transformations: a rounded result and the exact error that it left behind.
// Source: Dekker 1971 and Knuth (TAOCP 2, 4.2.2). The product is Dekker's, from halves: a fused multiply-add
// is a function call on machines of the baseline.
#pragma once

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

// A number of at most 2^995 as the sum of two of 26 bits.
struct Halves {
  double whole = 0.0;
  double high = 0.0;
  double low = 0.0;
};

inline Halves halves(double a) {
  const double wide = 0x1.0000002p27 * a, high = wide - (wide - a);
  return {a, high, a - high};
}

inline TwoFold two_product(const Halves& a, const Halves& b) {
  const double product = a.whole * b.whole;
  return {product, ((a.high * b.high - product) + a.high * b.low + a.low * b.high) + a.low * b.low};
}

}  // namespace rondure
