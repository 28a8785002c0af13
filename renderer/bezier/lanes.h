// Coefficients as short vectors that the compiler keeps in SIMD registers: the same arithmetic in the same
// order as on the GLM types, component by component, only faster.
#pragma once

#include <cstring>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace rondure::detail {

using Lanes2 = double __attribute__((vector_size(16)));

// Two halves, since a vector wider than the registers of the baseline machine would be spilled to memory.
struct Lanes4 {
  Lanes2 low, high;

  Lanes4& operator+=(const Lanes4& o) {
    low += o.low;
    high += o.high;
    return *this;
  }
  friend Lanes4 operator*(double s, const Lanes4& o) { return {s * o.low, s * o.high}; }
  friend Lanes4 operator+(const Lanes4& a, const Lanes4& b) { return {a.low + b.low, a.high + b.high}; }
  friend Lanes4 operator-(const Lanes4& a, const Lanes4& b) { return {a.low - b.low, a.high - b.high}; }
};

template <class T>
struct LanesOf {
  using type = T;
};
template <>
struct LanesOf<glm::dvec2> {
  using type = Lanes2;
};
template <>
struct LanesOf<glm::dvec4> {
  using type = Lanes4;
};
template <class T>
using Lanes = typename LanesOf<T>::type;

// The same bytes as another type of the same size.
template <class To, class From>
inline To lane_cast(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(static_cast<void*>(&to), &from, sizeof(To));
  return to;
}

}  // namespace rondure::detail
