// Composition f o g of a rational patch f with a planar rational map g into its parameter domain (Cobb 1988,
// section 9). Everything stays homogeneous, so that no division is made and the degree is the least possible.
//
// Of the paper's three routes (section 8) this is the second, products of Bernstein polynomials: at degree 8
// it loses an eps or two where interpolation at equal steps and the power basis lose 10^4 and more.
#pragma once

#include <vector>

#include "renderer/bezier/product.h"

namespace rondure {

// A planar rational map ((X / W), (Y / W)); the three polynomials have one degree. Polynomial is
// TensorPolynomial<S> or TrianglePolynomial<S>.
template <class Polynomial>
struct PlanarMap {
  Polynomial x, y, w;
};

namespace detail {

// powers[k] = p^k for k = 0..n.
template <class Polynomial>
std::vector<Polynomial> powers_of(const Polynomial& p, int n) {
  Polynomial one;
  one.coefficients[0] = 1;
  std::vector<Polynomial> powers{one};
  for (int k = 1; k <= n; ++k) powers.push_back(multiply(powers.back(), p));
  return powers;
}

template <class S>
TensorPolynomial<S> zero_like(const TensorPolynomial<S>& p, int times) {
  return TensorPolynomial<S>(p.m * times, p.n * times);
}
template <class S>
TrianglePolynomial<S> zero_like(const TrianglePolynomial<S>& p, int times) {
  return TrianglePolynomial<S>(p.n * times);
}

// sum += weight * p, for each coordinate of a control point.
template <class Polynomial>
void accumulate(Polynomial (&sum)[4], const Polynomial& p, const dvec4& weight, double factor) {
  for (int c = 0; c < 4; ++c) {
    for (std::size_t k = 0; k < p.coefficients.size(); ++k) {
      // In this order nothing is rounded to double before the end.
      sum[c].coefficients[k] += p.coefficients[k] * factor * weight[c];
    }
  }
}

template <class S>
TensorNet to_net(const TensorPolynomial<S> (&c)[4]) {
  TensorNet net(c[0].m, c[0].n);
  for (std::size_t k = 0; k < net.points.size(); ++k) {
    for (int d = 0; d < 4; ++d) net.points[k][d] = static_cast<double>(c[d].coefficients[k]);
  }
  return net;
}

template <class S>
TriangleNet to_net(const TrianglePolynomial<S> (&c)[4]) {
  TriangleNet net(c[0].n);
  for (std::size_t k = 0; k < net.points.size(); ++k) {
    for (int d = 0; d < 4; ++d) net.points[k][d] = static_cast<double>(c[d].coefficients[k]);
  }
  return net;
}

}  // namespace detail

// W^(m+n) f(X/W, Y/W) = sum P_ij C(m,i) X^i (W-X)^(m-i) C(n,j) Y^j (W-Y)^(n-j): degree m + n times that of g.
template <class Polynomial>
auto compose(const TensorNet& f, const PlanarMap<Polynomial>& g) {
  const auto px = detail::powers_of(g.x, f.m);
  const auto rx = detail::powers_of(add_scaled(g.w, g.x, -1), f.m);
  const auto py = detail::powers_of(g.y, f.n);
  const auto ry = detail::powers_of(add_scaled(g.w, g.y, -1), f.n);
  const Polynomial zero = detail::zero_like(g.x, f.m + f.n);
  Polynomial sum[4] = {zero, zero, zero, zero};
  for (int i = 0; i <= f.m; ++i) {
    const auto a = static_cast<std::size_t>(i);
    const Polynomial in_u = multiply(px[a], rx[static_cast<std::size_t>(f.m - i)]);
    for (int j = 0; j <= f.n; ++j) {
      const auto b = static_cast<std::size_t>(j);
      const Polynomial in_v = multiply(py[b], ry[static_cast<std::size_t>(f.n - j)]);
      detail::accumulate(sum, multiply(in_u, in_v), f.at(i, j), binomial(f.m, i) * binomial(f.n, j));
    }
  }
  return detail::to_net(sum);
}

// W^n f(X/W, Y/W) = sum P_ijk n!/(i!j!k!) X^i Y^j (W-X-Y)^k: degree n times that of g.
template <class Polynomial>
auto compose(const TriangleNet& f, const PlanarMap<Polynomial>& g) {
  const auto px = detail::powers_of(g.x, f.n);
  const auto py = detail::powers_of(g.y, f.n);
  const auto pz = detail::powers_of(add_scaled(add_scaled(g.w, g.x, -1), g.y, -1), f.n);
  const Polynomial zero = detail::zero_like(g.x, f.n);
  Polynomial sum[4] = {zero, zero, zero, zero};
  for (int i = 0; i <= f.n; ++i) {
    for (int j = 0; j <= f.n - i; ++j) {
      const Polynomial xy = multiply(px[static_cast<std::size_t>(i)], py[static_cast<std::size_t>(j)]);
      detail::accumulate(sum, multiply(xy, pz[static_cast<std::size_t>(f.n - i - j)]), f.at(i, j),
                         trinomial(f.n, i, j));
    }
  }
  return detail::to_net(sum);
}

}  // namespace rondure
