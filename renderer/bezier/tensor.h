// Tensor-product Bernstein polynomials of degree (m, n), over any coefficient type that forms linear
// combinations (double, dvec2, dvec3, dvec4). Coefficient (i, j) stands at net[i * (n + 1) + j], i along u, j
// along v.
//
// The evaluators take the degrees as template arguments too; with `dynamic` they use the run-time ones,
// otherwise every loop has a fixed count. Values are good to a few eps * max |net| on [0, 1]^2 and stay valid
// outside.
#pragma once

#include <algorithm>

#include "renderer/bezier/bernstein.h"
#include "renderer/bezier/curve.h"
#include "renderer/bezier/lanes.h"

namespace rondure {

template <class T>
struct FirstOrder {
  T value, du, dv;
};

template <class T>
struct SecondOrder {
  T value, du, dv, duu, duv, dvv;
};

template <int M = dynamic, int N = dynamic, class T>
T tensor_value(const T* net, int m, int n, double u, double v) {
  const int deg_u = M >= 0 ? M : m;
  const int deg_v = N >= 0 ? N : n;
  double bu[(M >= 0 ? M : max_degree) + 1];
  double bv[(N >= 0 ? N : max_degree) + 1];
  bernstein_values<M>(deg_u, u, bu);
  bernstein_values<N>(deg_v, v, bv);
  T sum(0.0);
  for (int i = 0; i <= deg_u; ++i) {
    const T* row = net + i * (deg_v + 1);
    T r = bv[0] * row[0];
    for (int j = 1; j <= deg_v; ++j) r += bv[j] * row[j];
    sum += bu[i] * r;
  }
  return sum;
}

// The four sums over the corner sub-nets of degree (m - 1, n - 1) give value and derivatives at once: the
// last step of de Casteljau's algorithm in both directions.
template <int M = dynamic, int N = dynamic, class T>
FirstOrder<T> tensor_first(const T* net, int m, int n, double u, double v) {
  const int deg_u = M >= 0 ? M : m;
  const int deg_v = N >= 0 ? N : n;
  // A direction of degree 0 reads its only coefficient twice and multiplies the difference by 0.
  const int lu = std::max(deg_u - 1, 0);
  const int lv = std::max(deg_v - 1, 0);
  const int step_u = std::min(deg_u, 1);
  const int step_v = std::min(deg_v, 1);
  double bu[(M >= 0 ? M : max_degree) + 1];
  double bv[(N >= 0 ? N : max_degree) + 1];
  bernstein_values<(M > 0 ? M - 1 : M)>(lu, u, bu);
  bernstein_values<(N > 0 ? N - 1 : N)>(lv, v, bv);
  using L = detail::Lanes<T>;
  L s00{}, s01{}, s10{}, s11{};
  for (int i = 0; i <= deg_u; ++i) {
    const T* row = net + i * (deg_v + 1);
    L low{}, high{};
    for (int j = 0; j <= lv; ++j) {
      low += bv[j] * detail::lane_cast<L>(row[j]);
      high += bv[j] * detail::lane_cast<L>(row[j + step_v]);
    }
    if (i <= lu) {
      s00 += bu[i] * low;
      s01 += bu[i] * high;
    }
    if (i >= step_u) {
      s10 += bu[i - step_u] * low;
      s11 += bu[i - step_u] * high;
    }
  }
  const double su = 1.0 - u;
  const double sv = 1.0 - v;
  const L left = sv * s00 + v * s01;
  const L right = sv * s10 + v * s11;
  const L value = su * left + u * right;
  const L in_u = static_cast<double>(deg_u) * (right - left);
  const L in_v = static_cast<double>(deg_v) * (su * (s01 - s00) + u * (s11 - s10));
  return {detail::lane_cast<T>(value), detail::lane_cast<T>(in_u), detail::lane_cast<T>(in_v)};
}

namespace detail {

// Basis functions with their first and second derivatives.
template <int N>
struct BasisJet {
  static constexpr int size = (N >= 0 ? N : max_degree) + 1;
  double b[size], d[size], dd[size];

  BasisJet(int n, double t) {
    bernstein_values<N>(n, t, b);
    double lower[size];
    if (n > 0) bernstein_values<dynamic>(n - 1, t, lower);
    for (int k = 0; k <= n; ++k) {
      d[k] = n * ((k > 0 ? lower[k - 1] : 0.0) - (k < n ? lower[k] : 0.0));
    }
    if (n > 1) bernstein_values<dynamic>(n - 2, t, lower);
    for (int k = 0; k <= n; ++k) {
      if (n < 2) {
        dd[k] = 0.0;
        continue;
      }
      const double before = k > 1 ? lower[k - 2] : 0.0;
      const double here = k > 0 && k < n ? lower[k - 1] : 0.0;
      const double after = k < n - 1 ? lower[k] : 0.0;
      dd[k] = n * (n - 1) * (before - 2.0 * here + after);
    }
  }
};

}  // namespace detail

template <int M = dynamic, int N = dynamic, class T>
SecondOrder<T> tensor_second(const T* net, int m, int n, double u, double v) {
  const int deg_u = M >= 0 ? M : m;
  const int deg_v = N >= 0 ? N : n;
  const detail::BasisJet<M> bu(deg_u, u);
  const detail::BasisJet<N> bv(deg_v, v);
  SecondOrder<T> s{T(0.0), T(0.0), T(0.0), T(0.0), T(0.0), T(0.0)};
  for (int i = 0; i <= deg_u; ++i) {
    const T* row = net + i * (deg_v + 1);
    T r = bv.b[0] * row[0];
    T r1 = bv.d[0] * row[0];
    T r2 = bv.dd[0] * row[0];
    for (int j = 1; j <= deg_v; ++j) {
      r += bv.b[j] * row[j];
      r1 += bv.d[j] * row[j];
      r2 += bv.dd[j] * row[j];
    }
    s.value += bu.b[i] * r;
    s.du += bu.d[i] * r;
    s.dv += bu.b[i] * r1;
    s.duu += bu.dd[i] * r;
    s.duv += bu.d[i] * r1;
    s.dvv += bu.b[i] * r2;
  }
  return s;
}

// The same from the nine sums over sub-nets of degree (m - 2, n - 2): rounded otherwise, in half the time.
template <int M = dynamic, int N = dynamic, class T>
SecondOrder<T> tensor_second_by_sums(const T* net, int m, int n, double u, double v) {
  const int deg_u = M >= 0 ? M : m;
  const int deg_v = N >= 0 ? N : n;
  if (deg_u < 2 || deg_v < 2) return tensor_second<M, N>(net, m, n, u, v);
  double bu[(M >= 0 ? M : max_degree) + 1];
  double bv[(N >= 0 ? N : max_degree) + 1];
  bernstein_values<(M > 1 ? M - 2 : M)>(deg_u - 2, u, bu);
  bernstein_values<(N > 1 ? N - 2 : N)>(deg_v - 2, v, bv);
  using L = detail::Lanes<T>;
  L s[3][3] = {};
  for (int i = 0; i <= deg_u; ++i) {
    const T* row = net + i * (deg_v + 1);
    L r[3] = {};
    for (int j = 0; j <= deg_v - 2; ++j)
      for (int k = 0; k < 3; ++k) r[k] += bv[j] * detail::lane_cast<L>(row[j + k]);
    for (int l = 0; l < 3; ++l)
      if (i >= l && i - l <= deg_u - 2)
        for (int k = 0; k < 3; ++k) s[l][k] += bu[i - l] * r[k];
  }
  const double su = 1.0 - u, sv = 1.0 - v;
  L value[3], in_v[3], in_vv[3];
  for (int l = 0; l < 3; ++l) {
    const L low = sv * s[l][0] + v * s[l][1], high = sv * s[l][1] + v * s[l][2];
    value[l] = sv * low + v * high, in_v[l] = high - low;
    in_vv[l] = (s[l][2] - s[l][1]) - (s[l][1] - s[l][0]);
  }
  const L low = su * value[0] + u * value[1], high = su * value[1] + u * value[2];
  const L low_v = su * in_v[0] + u * in_v[1], high_v = su * in_v[1] + u * in_v[2];
  const double by_u = deg_u, by_v = deg_v;
  const L results[6] = {
      su * low + u * high,
      by_u * (high - low),
      by_v * (su * low_v + u * high_v),
      by_u * (by_u - 1.0) * ((value[2] - value[1]) - (value[1] - value[0])),
      by_u * by_v * (high_v - low_v),
      by_v * (by_v - 1.0) * (su * (su * in_vv[0] + u * in_vv[1]) + u * (su * in_vv[1] + u * in_vv[2]))};
  const auto as = [&](int k) { return detail::lane_cast<T>(results[k]); };
  return {as(0), as(1), as(2), as(3), as(4), as(5)};
}

// The same polynomial over [u0, u1] x [v0, v1], as a net over the unit square; the limits may lie anywhere
// and in either order. Neighbours cut at the same parameter agree there bit for bit. `out` may be `net`.
template <class T>
void tensor_restrict(const T* net, int m, int n, double u0, double u1, double v0, double v1, T* out) {
  T rows[max_net_size], columns[max_net_size];
  curves_restrict(net, m, n + 1, u0, u1, rows);
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= n; ++j) columns[j * (m + 1) + i] = rows[i * (n + 1) + j];
  curves_restrict(columns, n, m + 1, v0, v1, columns);
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= n; ++j) out[i * (n + 1) + j] = columns[j * (m + 1) + i];
}

// The halves u in [0, 1/2] and [1/2, 1], each over the unit square.
template <class T>
void tensor_halve_u(const T* net, int m, int n, T* low, T* high) {
  const int stride = n + 1;
  for (int j = 0; j <= n; ++j) curve_halve(net + j, m, stride, low + j, high + j);
}

template <class T>
void tensor_halve_v(const T* net, int m, int n, T* low, T* high) {
  const int stride = n + 1;
  for (int i = 0; i <= m; ++i) {
    curve_halve(net + i * stride, n, 1, low + i * stride, high + i * stride);
  }
}

// d/du as a net of degree (m - 1, n), m >= 1.
template <class T>
void tensor_derivative_u(const T* net, int m, int n, T* out) {
  for (int k = 0; k < m * (n + 1); ++k) out[k] = static_cast<double>(m) * (net[k + n + 1] - net[k]);
}

// d/dv as a net of degree (m, n - 1), n >= 1.
template <class T>
void tensor_derivative_v(const T* net, int m, int n, T* out) {
  for (int i = 0; i <= m; ++i) {
    for (int j = 0; j < n; ++j) {
      out[i * n + j] = static_cast<double>(n) * (net[i * (n + 1) + j + 1] - net[i * (n + 1) + j]);
    }
  }
}

}  // namespace rondure
