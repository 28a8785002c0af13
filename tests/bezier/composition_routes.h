// Three routes to the net of a composition (Cobb 1988, section 8), in any arithmetic.
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "renderer/bezier/compose.h"

namespace rondure::routes {

template <class S>
using Poly = TensorPolynomial<S>;

// The four coordinates of a net, and a planar map of double control points, in any arithmetic.
template <class S>
using Coordinates = std::array<Poly<S>, 4>;

template <class S>
Poly<S> converted(const Poly<double>& p) {
  Poly<S> out(p.m, p.n);
  for (std::size_t k = 0; k < p.coefficients.size(); ++k) out.coefficients[k] = S(p.coefficients[k]);
  return out;
}

template <class S>
S power(const S& x, int n) {
  S p = 1;
  for (int k = 0; k < n; ++k) p *= x;
  return p;
}

template <class S>
std::vector<S> bernstein(int n, const S& t) {
  std::vector<S> b;
  for (int k = 0; k <= n; ++k) b.push_back(S(binomial(n, k)) * power(t, k) * power(S(1 - t), n - k));
  return b;
}

template <class S>
S value(const Poly<S>& p, const S& u, const S& v) {
  const std::vector<S> bu = bernstein(p.m, u), bv = bernstein(p.n, v);
  S sum = 0;
  for (int i = 0; i <= p.m; ++i) {
    for (int j = 0; j <= p.n; ++j)
      sum += bu[static_cast<std::size_t>(i)] * bv[static_cast<std::size_t>(j)] * p.at(i, j);
  }
  return sum;
}

// W^(m+n) f(X/W, Y/W) at a point of the net's parameters.
template <class S>
std::array<S, 4> composed_value(const TensorNet& f, const PlanarMap<Poly<S>>& g, const S& u, const S& v) {
  const S x = value(g.x, u, v), y = value(g.y, u, v), w = value(g.w, u, v);
  std::array<S, 4> sum{};
  for (int i = 0; i <= f.m; ++i) {
    for (int j = 0; j <= f.n; ++j) {
      const S b = S(binomial(f.m, i)) * S(binomial(f.n, j)) * power(x, i) * power(S(w - x), f.m - i) *
                  power(y, j) * power(S(w - y), f.n - j);
      for (std::size_t c = 0; c < 4; ++c) sum[c] += b * S(f.at(i, j)[static_cast<int>(c)]);
    }
  }
  return sum;
}

// A x = b for every column of b, by elimination with row pivoting.
template <class S>
void solve(std::vector<std::vector<S>> a, std::vector<std::vector<S>>& b) {
  using std::abs;
  const std::size_t n = a.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t best = c;
    for (std::size_t r = c + 1; r < n; ++r) {
      if (abs(a[r][c]) > abs(a[best][c])) best = r;
    }
    std::swap(a[c], a[best]);
    std::swap(b[c], b[best]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const S factor = a[r][c] / a[c][c];
      for (std::size_t k = c; k < n; ++k) a[r][k] -= factor * a[c][k];
      for (std::size_t k = 0; k < b[r].size(); ++k) b[r][k] -= factor * b[c][k];
    }
  }
  for (std::size_t r = 0; r < n; ++r) {
    for (S& x : b[r]) x /= a[r][r];
  }
}

// The first route: the composition's values on a grid of as many nodes as coefficients, then interpolation in
// one direction after the other.
template <class S>
Coordinates<S> by_interpolation(const TensorNet& f, const PlanarMap<Poly<S>>& g) {
  const int m = (f.m + f.n) * g.x.m, n = (f.m + f.n) * g.x.n;
  const auto collocation = [](int d) {
    std::vector<std::vector<S>> rows;
    for (int i = 0; i <= d; ++i) rows.push_back(bernstein(d, S(i) / S(d)));
    return rows;
  };
  std::vector<std::vector<S>> in_u(static_cast<std::size_t>(m) + 1);
  for (int i = 0; i <= m; ++i) {
    for (int j = 0; j <= n; ++j) {
      for (const S& c : composed_value(f, g, S(S(i) / S(m)), S(S(j) / S(n))))
        in_u[static_cast<std::size_t>(i)].push_back(c);
    }
  }
  solve(collocation(m), in_u);
  std::vector<std::vector<S>> in_v(static_cast<std::size_t>(n) + 1);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= m; ++i) {
      for (int c = 0; c < 4; ++c) {
        in_v[static_cast<std::size_t>(j)].push_back(
            in_u[static_cast<std::size_t>(i)][static_cast<std::size_t>(4 * j + c)]);
      }
    }
  }
  solve(collocation(n), in_v);
  Coordinates<S> out;
  for (std::size_t c = 0; c < 4; ++c) {
    out[c] = Poly<S>(m, n);
    for (int i = 0; i <= m; ++i) {
      for (int j = 0; j <= n; ++j)
        out[c].at(i, j) = in_v[static_cast<std::size_t>(j)][static_cast<std::size_t>(4 * i) + c];
    }
  }
  return out;
}

// The second route, the library's.
template <class S>
Coordinates<S> by_products(const TensorNet& f, const PlanarMap<Poly<S>>& g) {
  const auto net = compose(f, g);
  Coordinates<S> out;
  for (std::size_t c = 0; c < 4; ++c) {
    out[c] = Poly<S>(net.m, net.n);
    for (std::size_t k = 0; k < net.points.size(); ++k)
      out[c].coefficients[k] = net.points[k][static_cast<int>(c)];
  }
  return out;
}

// The third: powers of u and v, as a symbolic algebra system has them. at(i, j) is the coefficient of u^i
// v^j.
template <class S>
Poly<S> to_powers(const Poly<S>& p) {
  Poly<S> out(p.m, p.n);
  for (int i = 0; i <= p.m; ++i) {
    for (int j = 0; j <= p.n; ++j) {
      for (int k = 0; k <= i; ++k) {
        for (int l = 0; l <= j; ++l) {
          const double sign = (i + k + j + l) % 2 == 0 ? 1.0 : -1.0;
          out.at(i, j) +=
              S(sign * binomial(p.m, i) * binomial(i, k) * binomial(p.n, j) * binomial(j, l)) * p.at(k, l);
        }
      }
    }
  }
  return out;
}

template <class S>
Poly<S> from_powers(const Poly<S>& p) {
  Poly<S> out(p.m, p.n);
  for (int i = 0; i <= p.m; ++i) {
    for (int j = 0; j <= p.n; ++j) {
      for (int k = 0; k <= i; ++k) {
        for (int l = 0; l <= j; ++l) {
          out.at(i, j) += S(binomial(i, k)) / S(binomial(p.m, k)) *
                          (S(binomial(j, l)) / S(binomial(p.n, l))) * p.at(k, l);
        }
      }
    }
  }
  return out;
}

template <class S>
Poly<S> power_product(const Poly<S>& a, const Poly<S>& b) {
  Poly<S> out(a.m + b.m, a.n + b.n);
  for (int i = 0; i <= a.m; ++i) {
    for (int j = 0; j <= a.n; ++j) {
      for (int k = 0; k <= b.m; ++k) {
        for (int l = 0; l <= b.n; ++l) out.at(i + k, j + l) += a.at(i, j) * b.at(k, l);
      }
    }
  }
  return out;
}

template <class S>
Coordinates<S> by_powers(const TensorNet& f, const PlanarMap<Poly<S>>& g) {
  const int degree = f.m + f.n;
  const auto powers = [&](const Poly<S>& p) {
    std::vector<Poly<S>> all(1);
    all[0].coefficients[0] = 1;
    for (int k = 1; k <= degree; ++k) all.push_back(power_product(all.back(), to_powers(p)));
    return all;
  };
  const auto x = powers(g.x), y = powers(g.y), w = powers(g.w);
  Coordinates<S> out;
  for (std::size_t c = 0; c < 4; ++c) {
    Poly<S> net(f.m, f.n), sum(degree * g.x.m, degree * g.x.n);
    for (std::size_t k = 0; k < f.points.size(); ++k)
      net.coefficients[k] = S(f.points[k][static_cast<int>(c)]);
    const Poly<S> a = to_powers(net);
    for (int i = 0; i <= f.m; ++i) {
      for (int j = 0; j <= f.n; ++j) {
        const auto xy = power_product(x[static_cast<std::size_t>(i)], y[static_cast<std::size_t>(j)]);
        sum = add_scaled(sum, power_product(xy, w[static_cast<std::size_t>(degree - i - j)]), a.at(i, j));
      }
    }
    out[c] = from_powers(sum);
  }
  return out;
}

}  // namespace rondure::routes
