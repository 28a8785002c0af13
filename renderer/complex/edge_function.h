// Polynomials and rational functions of the parameter s of an edge, in exact arithmetic.
#pragma once

#include <optional>
#include <vector>

#include "renderer/bezier/exact.h"

namespace rondure {

// Coefficient k belongs to s^k; the last one is not zero, and the polynomial 0 has none.
class EdgePolynomial {
 public:
  EdgePolynomial() = default;
  EdgePolynomial(Exact constant) : EdgePolynomial(std::vector<Exact>{std::move(constant)}) {}
  EdgePolynomial(int constant) : EdgePolynomial(Exact(constant)) {}
  explicit EdgePolynomial(std::vector<Exact> coefficients);

  const std::vector<Exact>& coefficients() const { return coefficients_; }
  int degree() const { return static_cast<int>(coefficients_.size()) - 1; }  // -1 for 0
  bool zero() const { return coefficients_.empty(); }
  Exact at(const Exact& s) const;
  double at(double s) const;
  EdgePolynomial derivative() const;

  friend EdgePolynomial operator+(const EdgePolynomial& a, const EdgePolynomial& b);
  friend EdgePolynomial operator-(const EdgePolynomial& a, const EdgePolynomial& b);
  friend EdgePolynomial operator*(const EdgePolynomial& a, const EdgePolynomial& b);

 private:
  std::vector<Exact> coefficients_;
};

// c0 + c1 s.
EdgePolynomial linear(const Exact& c0, const Exact& c1);
// From Bernstein coefficients over [0, 1], and to those of any degree not below its own.
EdgePolynomial from_bernstein(const std::vector<Exact>& coefficients);
std::vector<Exact> bernstein_coefficients(const EdgePolynomial& p, int degree);
EdgePolynomial power(const EdgePolynomial& p, int exponent);
// C(n, k) (1 - s)^(n - k) s^k.
EdgePolynomial bernstein_polynomial(int n, int k);
// b^n p(a / b), for n >= the degree of p.
EdgePolynomial compose(const EdgePolynomial& p, int n, const EdgePolynomial& a, const EdgePolynomial& b);
// A place in [0, 1] where p is not positive, from Bernstein's coefficients and halving: without one, p > 0
// there is proved. Where p is positive but below some 2^-50 of its size, that place may be returned.
std::optional<Exact> not_positive(const EdgePolynomial& p);

// numerator / denominator.
struct EdgeFunction {
  EdgePolynomial numerator;
  EdgePolynomial denominator = 1;

  EdgeFunction() = default;
  EdgeFunction(EdgePolynomial n, EdgePolynomial d = 1) : numerator(std::move(n)), denominator(std::move(d)) {}
  EdgeFunction(int constant) : numerator(constant) {}
  Exact at(const Exact& s) const { return numerator.at(s) / denominator.at(s); }
  double at(double s) const { return numerator.at(s) / denominator.at(s); }
  bool zero() const { return numerator.zero(); }
};

EdgeFunction operator+(const EdgeFunction& a, const EdgeFunction& b);
EdgeFunction operator-(const EdgeFunction& a, const EdgeFunction& b);
EdgeFunction operator*(const EdgeFunction& a, const EdgeFunction& b);
EdgeFunction operator/(const EdgeFunction& a, const EdgeFunction& b);
EdgeFunction derivative(const EdgeFunction& f);
// f(map(s)).
EdgeFunction compose(const EdgeFunction& f, const EdgeFunction& map);

}  // namespace rondure
