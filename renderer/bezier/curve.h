// Univariate Bernstein polynomials: the pieces of which the tensor-product operations are made. Degrees up to
// max_degree; input and output may be the same array.
#pragma once

#include <algorithm>

#include "renderer/bezier/bernstein.h"

namespace rondure {

namespace detail {

// One step of de Casteljau's algorithm: n + 1 coefficients become n. Or as many rows of `width` each: the
// inner loop is one flat run either way, which is what compilers make vector instructions of.
template <class T>
void casteljau_step(T* a, int n, double t, int width = 1) {
  const double s = 1.0 - t;
  for (int k = 0; k < n * width; ++k) a[k] = s * a[k] + t * a[k + width];
}

}  // namespace detail

// `width` polynomials over [t0, t1], given as n + 1 rows with a coefficient of each: row k is the blossom at
// t0 (n - k times) and t1 (k times).
template <class T>
void curves_restrict(const T* in, int n, int width, double t0, double t1, T* out) {
  T start[max_net_size];
  T work[max_net_size];
  std::copy(in, in + (n + 1) * width, start);
  // `start` holds n - r arguments equal to t0 already spent, which leaves a polynomial of degree r for t1.
  for (int r = n; r >= 0; --r) {
    std::copy(start, start + (r + 1) * width, work);
    for (int k = r; k > 0; --k) detail::casteljau_step(work, k, t1, width);
    std::copy(work, work + width, out + r * width);
    detail::casteljau_step(start, r, t0, width);
  }
}

// Both halves of a polynomial whose coefficients are `stride` apart.
template <class T>
void curve_halve(const T* in, int n, int stride, T* low, T* high) {
  T work[max_degree + 1];
  for (int k = 0; k <= n; ++k) work[k] = in[k * stride];
  for (int r = n; r >= 0; --r) {
    low[(n - r) * stride] = work[0];
    high[r * stride] = work[r];
    for (int k = 0; k < r; ++k) work[k] = 0.5 * (work[k] + work[k + 1]);
  }
}

}  // namespace rondure
