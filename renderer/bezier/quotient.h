// A division that may be by zero.
#pragma once

namespace rondure {

// a / b as IEEE 754 has it: infinite, or no number, where b is zero. For what a minimum then bounds, and for
// what a comparison refuses that NaN fails. Sanitizers report zero divisors everywhere else.
template <class T>
__attribute__((no_sanitize("float-divide-by-zero"))) constexpr T quotient(T a, T b) {
  return a / b;
}

}  // namespace rondure
