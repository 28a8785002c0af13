// Univariate Bernstein polynomials in strided arrays: the pieces of which the tensor-product operations are
// made. Degrees up to max_degree; input and output may be the same array, with the same stride.
#pragma once

#include "renderer/bezier/bernstein.h"

namespace rondure {

namespace detail {

// One step of de Casteljau's algorithm: n + 1 coefficients become n.
template <class T>
void casteljau_step(T* a, int n, double t) {
  const double s = 1.0 - t;
  for (int k = 0; k < n; ++k) a[k] = s * a[k] + t * a[k + 1];
}

}  // namespace detail

// The polynomial over [t0, t1]: coefficient k is the blossom at t0 (n - k times) and t1 (k times).
template <class T>
void curve_restrict(const T* in, int n, int in_stride, double t0, double t1, T* out, int out_stride) {
  T start[max_degree + 1];
  T work[max_degree + 1];
  for (int k = 0; k <= n; ++k) start[k] = in[k * in_stride];
  // `start` holds n - r arguments equal to t0 already spent, which leaves a polynomial of degree r for t1.
  for (int r = n; r >= 0; --r) {
    for (int k = 0; k <= r; ++k) work[k] = start[k];
    for (int k = r; k > 0; --k) detail::casteljau_step(work, k, t1);
    out[r * out_stride] = work[0];
    detail::casteljau_step(start, r, t0);
  }
}

template <class T>
void curve_halve(const T* in, int n, int in_stride, T* low, T* high, int out_stride) {
  T work[max_degree + 1];
  for (int k = 0; k <= n; ++k) work[k] = in[k * in_stride];
  for (int r = n; r >= 0; --r) {
    low[(n - r) * out_stride] = work[0];
    high[r * out_stride] = work[r];
    for (int k = 0; k < r; ++k) work[k] = 0.5 * (work[k] + work[k + 1]);
  }
}

}  // namespace rondure
