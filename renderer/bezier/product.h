// Products of Bernstein polynomials, by convolution of the scaled coefficients C(m, i) C(n, j) a_ij.
//
// Polynomials here own their coefficients and may be of any degree. The product of coefficients is `op(a,
// b)`, by default a * b: any bilinear map gives the polynomial of its values.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "renderer/api/patch.h"
#include "renderer/bezier/bernstein.h"

namespace rondure {

// Coefficient (i, j) of degree (m, n) at coefficients[i * (n + 1) + j].
template <class T>
struct TensorPolynomial {
  int m = 0, n = 0;
  std::vector<T> coefficients{T(0)};

  TensorPolynomial() = default;
  TensorPolynomial(int degree_u, int degree_v)
      : m(degree_u), n(degree_v), coefficients(static_cast<std::size_t>((m + 1) * (n + 1)), T(0)) {}
  TensorPolynomial(int degree_u, int degree_v, std::vector<T> values)
      : m(degree_u), n(degree_v), coefficients(std::move(values)) {}

  T& at(int i, int j) { return coefficients[static_cast<std::size_t>(i * (n + 1) + j)]; }
  const T& at(int i, int j) const { return coefficients[static_cast<std::size_t>(i * (n + 1) + j)]; }
};

// Coefficient (i, j, n - i - j) of degree n at coefficients[triangle_index(n, i, j)].
template <class T>
struct TrianglePolynomial {
  int n = 0;
  std::vector<T> coefficients{T(0)};

  TrianglePolynomial() = default;
  explicit TrianglePolynomial(int degree)
      : n(degree), coefficients(static_cast<std::size_t>(triangle_size(degree)), T(0)) {}
  TrianglePolynomial(int degree, std::vector<T> values) : n(degree), coefficients(std::move(values)) {}

  T& at(int i, int j) { return coefficients[static_cast<std::size_t>(triangle_index(n, i, j))]; }
  const T& at(int i, int j) const { return coefficients[static_cast<std::size_t>(triangle_index(n, i, j))]; }
};

// n! / (i! j! (n - i - j)!)
constexpr double trinomial(int n, int i, int j) { return binomial(n, i) * binomial(n - i, j); }

namespace detail {

// C(n, 0..n), of any degree: one rounding each where the table ends.
inline std::vector<double> binomial_row(int n) {
  std::vector<double> row(static_cast<std::size_t>(n) + 1);
  long double c = 1.0L;
  for (int k = 0; k <= n; ++k) {
    row[static_cast<std::size_t>(k)] = n <= max_binomial_degree ? binomial(n, k) : static_cast<double>(c);
    c = c * static_cast<long double>(n - k) / static_cast<long double>(k + 1);
  }
  return row;
}

// factor(coefficient, binomial) for every coefficient.
template <class T, class Factor>
void for_binomials(TensorPolynomial<T>& p, Factor factor) {
  const std::vector<double> in_u = binomial_row(p.m), in_v = binomial_row(p.n);
  std::size_t at = 0;
  for (const double a : in_u) {
    for (const double b : in_v) factor(p.coefficients[at++], a * b);
  }
}

template <class T, class Factor>
void for_binomials(TrianglePolynomial<T>& p, Factor factor) {
  const std::vector<double> in_u = binomial_row(p.n);
  std::size_t at = 0;
  for (int i = 0; i <= p.n; ++i) {
    for (const double b : binomial_row(p.n - i)) {
      factor(p.coefficients[at++], in_u[static_cast<std::size_t>(i)] * b);
    }
  }
}

template <class Polynomial>
Polynomial scaled(Polynomial p) {
  for_binomials(p, [](auto& c, double b) { c *= b; });
  return p;
}

template <class Polynomial>
void unscale(Polynomial& p) {
  for_binomials(p, [](auto& c, double b) { c /= b; });
}

}  // namespace detail

template <class A, class B, class Op = std::multiplies<>>
auto multiply(const TensorPolynomial<A>& a, const TensorPolynomial<B>& b, Op op = {}) {
  using C = decltype(op(a.coefficients[0], b.coefficients[0]));
  const auto sa = detail::scaled(a);
  const auto sb = detail::scaled(b);
  TensorPolynomial<C> product(a.m + b.m, a.n + b.n);
  for (int i = 0; i <= a.m; ++i) {
    for (int j = 0; j <= a.n; ++j) {
      for (int k = 0; k <= b.m; ++k) {
        for (int l = 0; l <= b.n; ++l) product.at(i + k, j + l) += op(sa.at(i, j), sb.at(k, l));
      }
    }
  }
  detail::unscale(product);
  return product;
}

template <class A, class B, class Op = std::multiplies<>>
auto multiply(const TrianglePolynomial<A>& a, const TrianglePolynomial<B>& b, Op op = {}) {
  using C = decltype(op(a.coefficients[0], b.coefficients[0]));
  const auto sa = detail::scaled(a);
  const auto sb = detail::scaled(b);
  TrianglePolynomial<C> product(a.n + b.n);
  for (int i = 0; i <= a.n; ++i) {
    for (int j = 0; j <= a.n - i; ++j) {
      for (int k = 0; k <= b.n; ++k) {
        for (int l = 0; l <= b.n - k; ++l) product.at(i + k, j + l) += op(sa.at(i, j), sb.at(k, l));
      }
    }
  }
  detail::unscale(product);
  return product;
}

// a + factor * b; both of the same kind and degree.
template <class Polynomial, class Scalar>
Polynomial add_scaled(Polynomial a, const Polynomial& b, Scalar factor) {
  for (std::size_t k = 0; k < a.coefficients.size(); ++k) a.coefficients[k] += factor * b.coefficients[k];
  return a;
}

}  // namespace rondure
