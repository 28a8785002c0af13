// Bernstein basis polynomials B_k^n(t) = C(n, k) t^k (1 - t)^(n - k) and their coefficients.
#pragma once

#include <array>

namespace rondure {

// A template argument: the degree is known at run time only.
constexpr int dynamic = -1;

// Nets of a higher degree are refused where they enter, so that evaluation works in buffers on the stack.
constexpr int max_degree = 24;

// Coefficients of the largest net.
constexpr int max_net_size = (max_degree + 1) * (max_degree + 1);

// The normal polynomial of a net of degree n has degree 3 n - 2 at most.
constexpr int max_binomial_degree = 3 * max_degree;

namespace detail {

constexpr auto make_binomials() {
  std::array<std::array<double, max_binomial_degree + 1>, max_binomial_degree + 1> table{};
  for (std::size_t n = 0; n < table.size(); ++n) {
    table[n][0] = 1.0;
    for (std::size_t k = 1; k <= n; ++k) table[n][k] = table[n - 1][k - 1] + (k < n ? table[n - 1][k] : 0.0);
  }
  return table;
}

inline constexpr auto binomials = make_binomials();

}  // namespace detail

// C(n, k) for 0 <= k <= n <= max_binomial_degree; exact while it is below 2^53 (n <= 56).
constexpr double binomial(int n, int k) {
  return detail::binomials[static_cast<std::size_t>(n)][static_cast<std::size_t>(k)];
}

// out[k] = B_k^n(t) for k = 0..n, each with a relative error below (n + 2) eps; t may lie outside [0, 1].
template <int N>
constexpr void bernstein_values(int n, double t, double* out) {
  const int degree = N >= 0 ? N : n;
  const double s = 1.0 - t;
  double power = 1.0;
  for (int k = 0; k <= degree; ++k) {
    out[k] = binomial(degree, k) * power;
    power *= t;
  }
  power = s;
  for (int k = degree - 1; k >= 0; --k) {
    out[k] *= power;
    power *= s;
  }
}

constexpr void bernstein_values(int n, double t, double* out) { bernstein_values<dynamic>(n, t, out); }

}  // namespace rondure
