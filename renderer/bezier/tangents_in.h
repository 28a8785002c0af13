// Tangents of a patch in an arithmetic of choice: single precision to see what it does, more than double to
// know better.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "renderer/api/patch.h"
#include "renderer/bezier/bernstein.h"

namespace rondure {

template <class T>
using Vector3In = std::array<T, 3>;

template <class T>
Vector3In<T> cross_in(const Vector3In<T>& a, const Vector3In<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The point, and w times its derivatives.
template <class T>
struct TangentsIn {
  Vector3In<T> point, du, dv;
  T weight;
};

namespace detail {

template <class T>
struct SumIn {
  std::array<T, 4> value{};

  void add(const T& factor, const dvec4& p) {
    for (int c = 0; c < 4; ++c) value[static_cast<std::size_t>(c)] += factor * static_cast<T>(p[c]);
  }
};

template <class T>
std::vector<T> powers_in(int n, const T& x) {
  std::vector<T> p(static_cast<std::size_t>(n) + 1, T(1));
  for (std::size_t k = 1; k < p.size(); ++k) p[k] = p[k - 1] * x;
  return p;
}

// The Bernstein polynomials of degree n at t; none for n = -1.
template <class T>
std::vector<T> bernstein_in(int n, const T& t) {
  if (n < 0) return {};
  const T s = T(1) - t;
  const std::vector<T> a = powers_in(n, t), b = powers_in(n, s);
  std::vector<T> out;
  for (int k = 0; k <= n; ++k)
    out.push_back(static_cast<T>(binomial(n, k)) * a[static_cast<std::size_t>(k)] *
                  b[static_cast<std::size_t>(n - k)]);
  return out;
}

// Their derivatives.
template <class T>
std::vector<T> bernstein_slopes_in(int n, const T& t) {
  const std::vector<T> low = bernstein_in<T>(n - 1, t);
  std::vector<T> out(static_cast<std::size_t>(n) + 1, T(0));
  for (std::size_t k = 0; k < low.size(); ++k) {
    out[k] -= static_cast<T>(n) * low[k];
    out[k + 1] += static_cast<T>(n) * low[k];
  }
  return out;
}

template <class T>
TangentsIn<T> quotient_in(const SumIn<T>& x, const SumIn<T>& xu, const SumIn<T>& xv) {
  TangentsIn<T> t;
  t.weight = x.value[3];
  for (std::size_t c = 0; c < 3; ++c) {
    t.point[c] = x.value[c] / x.value[3];
    t.du[c] = xu.value[c] - xu.value[3] * t.point[c];
    t.dv[c] = xv.value[c] - xv.value[3] * t.point[c];
  }
  return t;
}

}  // namespace detail

template <class T>
TangentsIn<T> tangents_in(const TensorNet& net, const T& u, const T& v) {
  const std::vector<T> bu = detail::bernstein_in(net.m, u), du = detail::bernstein_slopes_in(net.m, u);
  const std::vector<T> bv = detail::bernstein_in(net.n, v), dv = detail::bernstein_slopes_in(net.n, v);
  detail::SumIn<T> x, xu, xv;
  for (int i = 0; i <= net.m; ++i) {
    for (int j = 0; j <= net.n; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const dvec4& p = net.at(i, j);
      x.add(bu[a] * bv[b], p);
      xu.add(du[a] * bv[b], p);
      xv.add(bu[a] * dv[b], p);
    }
  }
  return detail::quotient_in(x, xu, xv);
}

template <class T>
TangentsIn<T> tangents_in(const TriangleNet& net, const T& u, const T& v) {
  const T w = T(1) - u - v;
  const int n = net.n;
  detail::SumIn<T> x, xu, xv;
  const std::vector<T> pu = detail::powers_in(n, u), pv = detail::powers_in(n, v),
                       pw = detail::powers_in(n, w);
  const auto basis = [&](int degree, int i, int j) {
    return static_cast<T>(binomial(degree, i) * binomial(degree - i, j)) * pu[static_cast<std::size_t>(i)] *
           pv[static_cast<std::size_t>(j)] * pw[static_cast<std::size_t>(degree - i - j)];
  };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n - i; ++j) x.add(basis(n, i, j), net.at(i, j));
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n - i; ++j) {
      const T b = static_cast<T>(n) * basis(n - 1, i, j);
      xu.add(b, net.at(i + 1, j) - net.at(i, j));
      xv.add(b, net.at(i, j + 1) - net.at(i, j));
    }
  }
  return detail::quotient_in(x, xu, xv);
}

template <class T>
TangentsIn<T> tangents_in(const Net& net, const T& u, const T& v) {
  return std::visit([&](const auto& n) { return tangents_in(n, u, v); }, net);
}

}  // namespace rondure
