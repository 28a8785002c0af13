// Ranges of Bernstein polynomials. Rounding is to nearest: the bounds serve decisions that a later, more
// careful test repeats, or carry the caller's own error bound.
#pragma once

#include <algorithm>
#include <cmath>

namespace rondure {

struct Interval {
  double low = 0.0;
  double high = 0.0;

  bool contains_zero() const { return low <= 0.0 && high >= 0.0; }
  double magnitude() const { return std::max(-low, high); }
  // Smallest |x| over the interval; 0 when it contains 0.
  double mignitude() const { return contains_zero() ? 0.0 : std::min(std::abs(low), std::abs(high)); }
};

inline Interval operator+(Interval a, Interval b) { return {a.low + b.low, a.high + b.high}; }
inline Interval operator-(Interval a) { return {-a.high, -a.low}; }
inline Interval operator*(double s, Interval a) {
  return s < 0.0 ? Interval{s * a.high, s * a.low} : Interval{s * a.low, s * a.high};
}
inline Interval operator*(Interval a, Interval b) {
  const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {low, high};
}
// The divisor must not contain zero.
inline Interval operator/(Interval a, Interval b) { return a * Interval{1.0 / b.high, 1.0 / b.low}; }

}  // namespace rondure
