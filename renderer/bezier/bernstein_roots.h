// Every root of a univariate Bernstein polynomial in [0, 1], tangential ones included.
#pragma once

#include <array>
#include <cmath>

#include "renderer/bezier/bernstein.h"

namespace rondure {

struct BernsteinRoot {
  double t = 0.0;
  bool simple =
      false;  // the polynomial changes sign there, and once near it; else it comes within `noise` of 0
  double width = 0.0;  // where it is not simple: noise hides what there is this far on either side of t
};

// In order of t. What does not fit would lie closer together than the noise lets anybody tell.
struct BernsteinRoots {
  std::array<BernsteinRoot, 4 * max_degree> items{};
  int count = 0;

  void add(BernsteinRoot root) {
    if (count < static_cast<int>(items.size())) items[static_cast<std::size_t>(count++)] = root;
  }
  const BernsteinRoot* begin() const { return items.data(); }
  const BernsteinRoot* end() const { return items.data() + count; }
};

// `scaled`: the coefficients times C(n, k), as products leave them, so that the polynomial is (1 - t)^n times
// the sum of scaled[k] x^k with x = t / (1 - t). `noise` bounds the error of a coefficient (unscaled). Simple
// roots are good to 1e-9. By Descartes' rule of signs and subdivision (Lane and Riesenfeld 1981).
void isolate_roots(int n, const double* scaled, double noise, BernsteinRoots& out) noexcept;

namespace detail {

// The only root in [0, 1], scaled[0] and scaled[n] having opposite signs.
template <int N>
double simple_root(int n, const double* scaled) {
  const int degree = N >= 0 ? N : n;
  double middle = 0.0;
  for (int k = 0; k <= degree; ++k) middle += scaled[k];
  // In the lower half x lies in [0, 1]; in the upper half its reciprocal does, and the order is reversed.
  const bool upper = (middle > 0.0) == (scaled[0] > 0.0);
  double c[(N >= 0 ? N : max_degree) + 1];
  for (int k = 0; k <= degree; ++k) c[k] = scaled[upper ? degree - k : k];
  double low = 0.0, high = 1.0, x = middle == 0.0 ? 1.0 : c[0] / (c[0] - middle);
  for (int step = 0; step < 64; ++step) {
    double f = c[degree], slope = 0.0;
    for (int k = degree - 1; k >= 0; --k) slope = slope * x + f, f = f * x + c[k];
    ((f > 0.0) == (c[0] > 0.0) ? low : high) = x;
    double next = x - f / slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double moved = std::fabs(next - x);
    x = next;
    // Newton's method squares this; bisection ends here too, a little later.
    if (moved < 1e-9) break;
  }
  return upper ? 1.0 / (1.0 + x) : x / (1.0 + x);
}

}  // namespace detail

// The same where the degree is known and most polynomials have no root, or one.
template <int N>
void bernstein_roots(int n, const double* scaled, double noise, BernsteinRoots& out) noexcept {
  const int degree = N >= 0 ? N : n;
  const double sign = scaled[0] > 0.0 ? 1.0 : -1.0;
  // Coefficients from 0 to `first` have the sign of the first; from `last` to n they have the other one.
  int first = 0, last = degree;
  while (first <= degree && sign * scaled[first] > noise * binomial(degree, first)) ++first;
  if (first > degree) return;
  while (last >= 0 && -sign * scaled[last] > noise * binomial(degree, last)) --last;
  const bool one = first > 0 && last < degree && last - first <= 0;
  if (one)
    out.add({detail::simple_root<N>(degree, scaled), true, 0.0});
  else
    isolate_roots(degree, scaled, noise, out);
}

}  // namespace rondure
