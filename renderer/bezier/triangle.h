// Triangular Bernstein polynomials of degree n: sum of n!/(i! j! k!) u^i v^j w^k net[triangle_index(n, i, j)]
// with k = n - i - j and w = 1 - u - v. Derivatives are with respect to (u, v), w dependent.
#pragma once

#include <glm/vec2.hpp>

#include "renderer/api/patch.h"
#include "renderer/bezier/bernstein.h"
#include "renderer/bezier/tensor.h"

namespace rondure {

namespace detail {

// Basis functions of degree n in the order of triangle_index.
template <int N>
struct TriangleBasis {
  static constexpr int degree_bound = N >= 0 ? N : max_degree;
  double b[triangle_size(degree_bound)];

  TriangleBasis(int n, double u, double v) {
    const double w = 1.0 - u - v;
    double pv[degree_bound + 1], pw[degree_bound + 1];
    pv[0] = pw[0] = 1.0;
    for (int k = 0; k < n; ++k) {
      pv[k + 1] = pv[k] * v;
      pw[k + 1] = pw[k] * w;
    }
    double pu = 1.0;
    int at = 0;
    for (int i = 0; i <= n; ++i) {
      const double c = binomial(n, i) * pu;
      for (int j = 0; j <= n - i; ++j) b[at++] = c * (binomial(n - i, j) * (pv[j] * pw[n - i - j]));
      pu *= u;
    }
  }
};

}  // namespace detail

template <int N = dynamic, class T>
T triangle_value(const T* net, int n, double u, double v) {
  const int degree = N >= 0 ? N : n;
  const detail::TriangleBasis<N> basis(degree, u, v);
  T sum = basis.b[0] * net[0];
  for (int k = 1; k < triangle_size(degree); ++k) sum += basis.b[k] * net[k];
  return sum;
}

// From the three sums of degree n - 1 over the sub-nets at the corners.
template <int N = dynamic, class T>
FirstOrder<T> triangle_first(const T* net, int n, double u, double v) {
  const int degree = N >= 0 ? N : n;
  if (degree == 0) return {net[0], T(0.0), T(0.0)};
  constexpr int lower = N > 0 ? N - 1 : N;
  const detail::TriangleBasis<lower> basis(degree - 1, u, v);
  T su(0.0), sv(0.0), sw(0.0);
  int at = 0;
  for (int i = 0; i < degree; ++i) {
    for (int j = 0; j < degree - i; ++j, ++at) {
      const double b = basis.b[at];
      su += b * net[triangle_index(degree, i + 1, j)];
      sv += b * net[triangle_index(degree, i, j + 1)];
      sw += b * net[triangle_index(degree, i, j)];
    }
  }
  const double scale = degree;
  return {u * su + v * sv + (1.0 - u - v) * sw, scale * (su - sw), scale * (sv - sw)};
}

// From the six sums of degree n - 2.
template <int N = dynamic, class T>
SecondOrder<T> triangle_second(const T* net, int n, double u, double v) {
  const int degree = N >= 0 ? N : n;
  if (degree < 2) {
    const FirstOrder<T> f = triangle_first<N>(net, n, u, v);
    return {f.value, f.du, f.dv, T(0.0), T(0.0), T(0.0)};
  }
  constexpr int lower = N > 1 ? N - 2 : N;
  const detail::TriangleBasis<lower> basis(degree - 2, u, v);
  T uu(0.0), uv(0.0), uw(0.0), vv(0.0), vw(0.0), ww(0.0);
  int at = 0;
  for (int i = 0; i < degree - 1; ++i) {
    for (int j = 0; j < degree - 1 - i; ++j, ++at) {
      const double b = basis.b[at];
      uu += b * net[triangle_index(degree, i + 2, j)];
      uv += b * net[triangle_index(degree, i + 1, j + 1)];
      uw += b * net[triangle_index(degree, i + 1, j)];
      vv += b * net[triangle_index(degree, i, j + 2)];
      vw += b * net[triangle_index(degree, i, j + 1)];
      ww += b * net[triangle_index(degree, i, j)];
    }
  }
  const double w = 1.0 - u - v;
  const T su = u * uu + v * uv + w * uw;
  const T sv = u * uv + v * vv + w * vw;
  const T sw = u * uw + v * vw + w * ww;
  const double first = degree;
  const double second = first * (first - 1.0);
  return {u * su + v * sv + w * sw,
          first * (su - sw),
          first * (sv - sw),
          second * ((uu - uw) - (uw - ww)),
          second * ((uv - uw) - (vw - ww)),
          second * ((vv - vw) - (vw - ww))};
}

namespace detail {

// One step of de Casteljau's algorithm at (u, v): degree n becomes n - 1, in place.
template <class T>
void triangle_step(T* a, int n, dvec2 at) {
  const double w = 1.0 - at.x - at.y;
  int to = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n - i; ++j, ++to) {
      a[to] = at.x * a[triangle_index(n, i + 1, j)] + at.y * a[triangle_index(n, i, j + 1)] +
              w * a[triangle_index(n, i, j)];
    }
  }
}

}  // namespace detail

// The same polynomial over the triangle with corners (u, v) = corners[0] where the new u = 1, corners[1]
// where the new v = 1, corners[2] where the new w = 1: coefficient (i, j, k) is the blossom at the three
// corners, i, j and k times. `out` must not overlap `net`.
template <class T>
void triangle_restrict(const T* net, int n, const dvec2 corners[3], T* out) {
  constexpr int size = triangle_size(max_degree);
  T first[size], second[size], work[size];
  for (int k = 0; k < triangle_size(n); ++k) first[k] = net[k];
  for (int i = 0; i <= n; ++i) {
    for (int k = 0; k < triangle_size(n - i); ++k) second[k] = first[k];
    for (int j = 0; j <= n - i; ++j) {
      const int left = n - i - j;
      for (int k = 0; k < triangle_size(left); ++k) work[k] = second[k];
      for (int k = left; k > 0; --k) detail::triangle_step(work, k, corners[2]);
      out[triangle_index(n, i, j)] = work[0];
      detail::triangle_step(second, left, corners[1]);
    }
    detail::triangle_step(first, n - i, corners[0]);
  }
}

// Three triangles that meet at (u, v): `a` has it for its corner u = 1, `b` for v = 1, `c` for w = 1; the
// other corners and the orientation stay.
template <class T>
void triangle_split_at(const T* net, int n, double u, double v, T* a, T* b, T* c) {
  const dvec2 p(u, v), cu(1.0, 0.0), cv(0.0, 1.0), cw(0.0, 0.0);
  const dvec2 at_u[3] = {p, cv, cw};
  const dvec2 at_v[3] = {cu, p, cw};
  const dvec2 at_w[3] = {cu, cv, p};
  triangle_restrict(net, n, at_u, a);
  triangle_restrict(net, n, at_v, b);
  triangle_restrict(net, n, at_w, c);
}

// The edge from u = 1 to v = 1 halved: `low` keeps the corner u = 1, `high` the corner v = 1.
template <class T>
void triangle_bisect(const T* net, int n, T* low, T* high) {
  const dvec2 p(0.5, 0.5), cu(1.0, 0.0), cv(0.0, 1.0), cw(0.0, 0.0);
  const dvec2 first[3] = {cu, p, cw};
  const dvec2 second[3] = {p, cv, cw};
  triangle_restrict(net, n, first, low);
  triangle_restrict(net, n, second, high);
}

// Four similar triangles: at the corners u = 1, v = 1, w = 1, and the one between them.
template <class T>
void triangle_quarter(const T* net, int n, T* at_u, T* at_v, T* at_w, T* middle) {
  const dvec2 cu(1.0, 0.0), cv(0.0, 1.0), cw(0.0, 0.0);
  const dvec2 uv(0.5, 0.5), vw(0.0, 0.5), uw(0.5, 0.0);
  const dvec2 first[3] = {cu, uv, uw};
  const dvec2 second[3] = {uv, cv, vw};
  const dvec2 third[3] = {uw, vw, cw};
  const dvec2 fourth[3] = {vw, uw, uv};
  triangle_restrict(net, n, first, at_u);
  triangle_restrict(net, n, second, at_v);
  triangle_restrict(net, n, third, at_w);
  triangle_restrict(net, n, fourth, middle);
}

// d/du (v fixed, w dependent) as a net of degree n - 1, n >= 1.
template <class T>
void triangle_derivative_u(const T* net, int n, T* out) {
  int at = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n - i; ++j, ++at) {
      out[at] = static_cast<double>(n) * (net[triangle_index(n, i + 1, j)] - net[triangle_index(n, i, j)]);
    }
  }
}

// d/dv (u fixed, w dependent) as a net of degree n - 1, n >= 1.
template <class T>
void triangle_derivative_v(const T* net, int n, T* out) {
  int at = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n - i; ++j, ++at) {
      out[at] = static_cast<double>(n) * (net[triangle_index(n, i, j + 1)] - net[triangle_index(n, i, j)]);
    }
  }
}

}  // namespace rondure
