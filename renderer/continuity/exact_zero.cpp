#include "renderer/continuity/exact_zero.h"

#include <algorithm>
#include <cmath>

#include "renderer/bezier/index.h"

namespace rondure {
namespace {

// A polynomial in s and t with integer coefficients: of s^i t^j at c[i * (n + 1) + j].
struct Local {
  int m = 0, n = 0;
  std::vector<Integer> c{0};

  Local() = default;
  Local(int degree_s, int degree_t) : m(degree_s), n(degree_t), c(index((m + 1) * (n + 1))) {}
  Integer& at(int i, int j) { return c[index(i * (n + 1) + j)]; }
  const Integer& at(int i, int j) const { return c[index(i * (n + 1) + j)]; }
};

Local operator*(const Local& a, const Local& b) {
  Local out(a.m + b.m, a.n + b.n);
  for (int i = 0; i <= a.m; ++i) {
    for (int j = 0; j <= a.n; ++j) {
      const Integer& x = a.at(i, j);
      if (x == 0) continue;
      for (int k = 0; k <= b.m; ++k) {
        for (int l = 0; l <= b.n; ++l) {
          if (b.at(k, l) != 0) out.at(i + k, j + l) += x * b.at(k, l);
        }
      }
    }
  }
  return out;
}

// a + factor b.
Local sum(const Local& a, const Local& b, const Integer& factor) {
  Local out(std::max(a.m, b.m), std::max(a.n, b.n));
  for (int i = 0; i <= a.m; ++i) {
    for (int j = 0; j <= a.n; ++j) out.at(i, j) = a.at(i, j);
  }
  for (int i = 0; i <= b.m; ++i) {
    for (int j = 0; j <= b.n; ++j) out.at(i, j) += factor * b.at(i, j);
  }
  return out;
}

// By s or t.
Local derivative(const Local& p, int axis) {
  Local out(std::max(p.m - (axis == 0), 0), std::max(p.n - (axis == 1), 0));
  for (int i = axis == 0; i <= p.m; ++i) {
    for (int j = axis == 1; j <= p.n; ++j) {
      if (axis == 0) out.at(i - 1, j) = i * p.at(i, j);
      if (axis == 1) out.at(i, j - 1) = j * p.at(i, j);
    }
  }
  return out;
}

Local linear(const Integer& constant, const Integer& in_s, const Integer& in_t) {
  Local out(in_s != 0, in_t != 0);
  out.at(0, 0) = constant;
  if (in_s != 0) out.at(1, 0) = in_s;
  if (in_t != 0) out.at(0, 1) = in_t;
  return out;
}

std::vector<Local> powers(const Local& base, int most) {
  std::vector<Local> out{linear(1, 0, 0)};
  for (int k = 1; k <= most; ++k) out.push_back(out.back() * base);
  return out;
}

// The net's four coordinates about (u, v) = (a + b s, c + b t) / one, all times one positive number.
std::array<Local, 4> expanded(const IntegerNet& net, const Integer& a, const Integer& c, const Integer& b,
                              const Integer& one) {
  const auto u = powers(linear(a, b, 0), net.m), v = powers(linear(c, 0, b), net.n);
  const auto u1 = powers(net.triangle ? linear(one - a - c, -b, -b) : linear(one - a, -b, 0), net.m);
  const auto v1 = powers(linear(one - c, 0, -b), net.n);
  std::array<Local, 4> out;
  for (int i = 0; i <= net.m; ++i) {
    for (int j = 0; j <= (net.triangle ? net.n - i : net.n); ++j) {
      const Local basis = net.triangle
                              ? u[index(i)] * v[index(j)] * u1[index(net.n - i - j)]
                              : u[index(i)] * u1[index(net.m - i)] * v[index(j)] * v1[index(net.n - j)];
      const Integer factor = net.binomials(i, j);
      for (std::size_t d = 0; d < 4; ++d)
        out[d] = sum(out[d], basis, factor * net.points[net.place(i, j)][d]);
    }
  }
  return out;
}

// The sum of the sizes of all coefficients but one.
Integer others(const Local& p, int i, int j) {
  Integer total = 0;
  for (const Integer& c : p.c) total += abs(c);
  return total - abs(p.at(i, j));
}

// Whether one coefficient outweighs all others, so that its term decides the sign where s, t are -1 or 1.
bool outweighs(const Local& p, int i, int j) {
  return p.m >= i && p.n >= j && abs(p.at(i, j)) > others(p, i, j);
}

bool zero_inside(const std::array<Local, 4>& x) {
  std::array<Local, 4> d[2];  // along s and t
  for (std::size_t k = 0; k < 4; ++k) d[0][k] = derivative(x[k], 0), d[1][k] = derivative(x[k], 1);
  // w^2 times the derivative of the point itself.
  std::array<Local, 3> s[2];
  std::size_t largest = 0, axis = 0;
  Integer most = 0;
  for (std::size_t a = 0; a < 2; ++a) {
    for (std::size_t k = 0; k < 3; ++k) {
      s[a][k] = sum(x[3] * d[a][k], x[k] * d[a][3], -1);
      if (abs(s[a][k].at(0, 0)) > most) most = abs(s[a][k].at(0, 0)), largest = k, axis = a;
    }
  }
  if (!outweighs(s[axis][largest], 0, 0)) return false;
  const auto pair = [&](std::size_t i, std::size_t j) {
    return sum(s[0][i] * s[1][j], s[0][j] * s[1][i], -1);
  };
  const std::size_t k1 = (largest + 1) % 3, k2 = (largest + 2) % 3;
  const Local f = pair(largest, k1), g = pair(k2, largest);
  if (f.m < 1 || f.n < 1) return false;
  // So that one has no linear term in t, the other none in s.
  const Local zero;
  const Local in_s = sum(sum(zero, f, g.at(0, 1)), g, -f.at(0, 1));
  const Local in_t = sum(sum(zero, f, -g.at(1, 0)), g, f.at(1, 0));
  return outweighs(in_s, 1, 0) && outweighs(in_t, 0, 1);
}

bool zero_at(const std::array<Local, 4>& x) {
  // All minors of point and derivatives, at s = t = 0.
  const auto coefficient = [&](std::size_t d, int k) -> Integer {
    const Local& p = x[d];
    if (k == 0) return p.at(0, 0);
    if (k == 1) return p.m > 0 ? p.at(1, 0) : Integer(0);
    return p.n > 0 ? p.at(0, 1) : Integer(0);
  };
  const auto minor = [&](std::size_t a, std::size_t b, std::size_t c) {
    const auto pair = [&](std::size_t e, std::size_t f) -> Integer {
      return coefficient(e, 1) * coefficient(f, 2) - coefficient(f, 1) * coefficient(e, 2);
    };
    return Integer(coefficient(a, 0) * pair(b, c) + coefficient(b, 0) * pair(c, a) +
                   coefficient(c, 0) * pair(a, b));
  };
  return minor(1, 2, 3) == 0 && minor(2, 0, 3) == 0 && minor(0, 1, 3) == 0;
}

// x as a whole number of parts, of which there are `parts` in 1.
struct Fraction {
  std::int64_t whole = 0, parts = 1;
  double value() const { return static_cast<double>(whole) / static_cast<double>(parts); }
};

Fraction dyadic(double x, int bits) { return {std::llround(std::ldexp(x, bits)), std::int64_t{1} << bits}; }

// That of fewest parts within `distance` of x, which is from 0 to 1; x itself where there is none of 1000
// parts.
Fraction simplest_near(double x, double distance) {
  for (std::int64_t parts = 1; parts <= 1000; ++parts) {
    const Fraction f{std::llround(x * static_cast<double>(parts)), parts};
    if (std::abs(f.value() - x) <= distance) return f;
  }
  return dyadic(x, 52);
}

bool zero_at(const IntegerNet& net, const Fraction& u, const Fraction& v) {
  const Integer one = Integer(u.parts) * v.parts, a = Integer(u.whole) * v.parts,
                c = Integer(v.whole) * u.parts;
  const bool inside = a >= 0 && c >= 0 && (net.triangle ? a + c <= one : a <= one && c <= one);
  return inside && zero_at(expanded(net, a, c, 1, one));
}

}  // namespace

std::optional<double> proved_zero(const IntegerNet& net, double u, double v, int most_squares) {
  if (net.m < 1 || net.n < 1) return std::nullopt;
  constexpr int bits = 52;
  const Fraction own_u = dyadic(u, bits), own_v = dyadic(v, bits);
  if (own_u.value() == u && own_v.value() == v && zero_at(net, own_u, own_v)) return 0.0;
  // What it may have been before it was found by steps.
  const auto exactly_at = [&](const Fraction& x, const Fraction& y) -> std::optional<double> {
    if (!zero_at(net, x, y)) return std::nullopt;
    return std::max(std::abs(x.value() - u), std::abs(y.value() - v)) + 0x1p-53;
  };
  for (const int size : {40, 26, 20}) {
    const double distance = std::ldexp(1.0, -size);
    if (const auto within = exactly_at(simplest_near(u, distance), simplest_near(v, distance))) return within;
  }
  if (const auto within = exactly_at(dyadic(u, 20), dyadic(v, 20))) return within;
  const Integer one = Integer(1) << bits, a = own_u.whole, c = own_v.whole;
  for (const int size : {44, 36, 28, 20, 12}) {
    if (--most_squares < 0) break;
    const Integer b = Integer(1) << (bits - size);
    const bool inside =
        a >= b && c >= b && (net.triangle ? a + c + 2 * b <= one : a + b <= one && c + b <= one);
    if (inside && zero_inside(expanded(net, a, c, b, one))) return std::ldexp(1.0, -size) + 0x1p-53;
  }
  return std::nullopt;
}

}  // namespace rondure
