// Bernstein polynomials by their definition, in 50 decimal digits: no code shared with what is tested.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <random>
#include <vector>

#include "renderer/api/patch.h"

namespace rondure::oracle {

using Big = boost::multiprecision::cpp_bin_float_50;

struct BigPoint {
  Big c[4];
};

inline Big power(const Big& x, int n) {
  Big p = 1;
  for (int k = 0; k < n; ++k) p *= x;
  return p;
}

inline Big factorial(int n) {
  Big p = 1;
  for (int k = 2; k <= n; ++k) p *= k;
  return p;
}

// The derivative of order (a, b) in (u, v) of u^i v^j w^k, w = 1 - u - v.
inline Big monomial(int i, int j, int k, int a, int b, const Big& u, const Big& v) {
  if (i < 0 || j < 0 || k < 0) return 0;
  if (a > 0) {
    return i * monomial(i - 1, j, k, a - 1, b, u, v) - k * monomial(i, j, k - 1, a - 1, b, u, v);
  }
  if (b > 0) {
    return j * monomial(i, j - 1, k, a, b - 1, u, v) - k * monomial(i, j, k - 1, a, b - 1, u, v);
  }
  return power(u, i) * power(v, j) * power(1 - u - v, k);
}

// The derivative of order a of t^i (1 - t)^k: the triangle's with v = 0.
inline Big basis(int n, int i, int a, const Big& t) {
  return factorial(n) / (factorial(i) * factorial(n - i)) * monomial(i, 0, n - i, a, 0, t, 0);
}

inline BigPoint derivative(const TensorNet& net, int a, int b, const Big& u, const Big& v) {
  BigPoint sum{{0, 0, 0, 0}};
  for (int i = 0; i <= net.m; ++i) {
    const Big bu = basis(net.m, i, a, u);
    for (int j = 0; j <= net.n; ++j) {
      const Big b2 = bu * basis(net.n, j, b, v);
      for (int c = 0; c < 4; ++c) sum.c[c] += b2 * net.at(i, j)[c];
    }
  }
  return sum;
}

inline BigPoint derivative(const TriangleNet& net, int a, int b, const Big& u, const Big& v) {
  BigPoint sum{{0, 0, 0, 0}};
  for (int i = 0; i <= net.n; ++i) {
    for (int j = 0; j <= net.n - i; ++j) {
      const int k = net.n - i - j;
      const Big f = factorial(net.n) / (factorial(i) * factorial(j) * factorial(k));
      const Big b2 = f * monomial(i, j, k, a, b, u, v);
      for (int c = 0; c < 4; ++c) sum.c[c] += b2 * net.at(i, j)[c];
    }
  }
  return sum;
}

inline BigPoint derivative(const Net& net, int a, int b, const Big& u, const Big& v) {
  return std::visit([&](const auto& n) { return derivative(n, a, b, u, v); }, net);
}

// |computed - exact|, the largest component.
inline double distance(const dvec4& computed, const BigPoint& exact) {
  double largest = 0.0;
  for (int k = 0; k < 4; ++k) {
    const double d = static_cast<double>(abs(Big(computed[k]) - exact.c[k]));
    if (!(d <= largest)) largest = d;
  }
  return largest;
}

// The unit normal of the rational surface, from w (w X_u - w_u X) x (w X_v - w_v X).
inline dvec3 normal(const Net& net, const Big& u, const Big& v) {
  const BigPoint x = derivative(net, 0, 0, u, v), p = derivative(net, 1, 0, u, v),
                 q = derivative(net, 0, 1, u, v);
  Big a[3], b[3];
  for (int c = 0; c < 3; ++c) {
    a[c] = x.c[3] * p.c[c] - p.c[3] * x.c[c];
    b[c] = x.c[3] * q.c[c] - q.c[3] * x.c[c];
  }
  const Big n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const Big length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  return {static_cast<double>(n[0] / length), static_cast<double>(n[1] / length),
          static_cast<double>(n[2] / length)};
}

}  // namespace rondure::oracle
