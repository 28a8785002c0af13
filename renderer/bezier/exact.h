// Rational numbers without rounding.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace rondure {

using Integer = boost::multiprecision::cpp_int;
using Exact = boost::multiprecision::cpp_rational;

// The nearest double, or next to it.
inline double rounded(const Exact& x) { return x.convert_to<double>(); }

// Exactly the number, which must be finite.
Exact exact_of(double x);

// n! / (k! (n - k)!), of any size.
Integer exact_binomial(int n, int k);

}  // namespace rondure
