// Intervals that contain what they stand for: every operation rounds outward.
//
// Rounding is to nearest throughout; an end is moved outward by an ulp of itself, which is at least twice
// what the operation's rounding took away, and by the smallest number, for those that underflow.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace rondure {

template <class T>
struct Enclosure {
  T low = 0, high = 0;

  static Enclosure about(T middle, T radius) { return outward(middle - radius, middle + radius); }
  static Enclosure everything() {
    return {-std::numeric_limits<T>::infinity(), std::numeric_limits<T>::infinity()};
  }
  // What overflowed is beyond the largest number, not at infinity.
  static Enclosure outward(T low, T high) {
    constexpr T ulp = std::numeric_limits<T>::epsilon(), least = std::numeric_limits<T>::denorm_min(),
                most = std::numeric_limits<T>::max();
    low = std::min(low, most), high = std::max(high, -most);
    return {low - (std::abs(low) * ulp + least), high + (std::abs(high) * ulp + least)};
  }

  T magnitude() const { return std::max(-low, high); }

  friend Enclosure operator+(Enclosure a, Enclosure b) { return outward(a.low + b.low, a.high + b.high); }
  friend Enclosure operator-(Enclosure a, Enclosure b) { return outward(a.low - b.high, a.high - b.low); }
  friend Enclosure operator*(Enclosure a, Enclosure b) {
    const T p[4] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    // Zero times infinity, or products that are infinite both ways.
    if (std::isnan((p[0] + p[1]) + (p[2] + p[3]))) return everything();
    return outward(std::min(std::min(p[0], p[1]), std::min(p[2], p[3])),
                   std::max(std::max(p[0], p[1]), std::max(p[2], p[3])));
  }
  // Everything where the divisor may be zero.
  friend Enclosure operator/(Enclosure a, Enclosure b) {
    if (!(b.low > 0 || b.high < 0)) return everything();
    return a * outward(1 / b.high, 1 / b.low);
  }
};

// Times 2^exponent: exact, but where it leaves the numbers.
template <class T>
Enclosure<T> ldexp(Enclosure<T> a, int exponent) {
  const T low = std::ldexp(a.low, exponent), high = std::ldexp(a.high, exponent);
  if (std::ldexp(low, -exponent) == a.low && std::ldexp(high, -exponent) == a.high) return {low, high};
  return Enclosure<T>::outward(low, high);
}

// Of what is not negative; an end below zero is rounding's.
template <class T>
Enclosure<T> sqrt(Enclosure<T> a) {
  return Enclosure<T>::outward(std::sqrt(std::max(a.low, T(0))), std::sqrt(std::max(a.high, T(0))));
}

}  // namespace rondure
