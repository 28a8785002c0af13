#include "renderer/complex/edge_function.h"

#include <algorithm>
#include <utility>

#include "renderer/bezier/index.h"

namespace rondure {
namespace {

// The Bernstein coefficients over the two halves.
std::pair<std::vector<Exact>, std::vector<Exact>> halves(std::vector<Exact> b) {
  std::vector<Exact> low{b.front()}, high{b.back()};
  for (std::size_t left = b.size() - 1; left > 0; --left) {
    for (std::size_t k = 0; k < left; ++k) b[k] = (b[k] + b[k + 1]) / 2;
    low.push_back(b[0]);
    high.push_back(b[left - 1]);
  }
  std::reverse(high.begin(), high.end());
  return {std::move(low), std::move(high)};
}

std::optional<Exact> not_positive(const std::vector<Exact>& b, const Exact& from, const Exact& width,
                                  int depth) {
  if (b.front() <= 0) return from;
  if (b.back() <= 0) return from + width;
  if (std::all_of(b.begin(), b.end(), [](const Exact& c) { return c >= 0; })) return std::nullopt;
  if (depth == 0) return from + width / 2;
  const auto [low, high] = halves(b);
  if (auto found = not_positive(low, from, width / 2, depth - 1)) return found;
  return not_positive(high, from + width / 2, width / 2, depth - 1);
}

}  // namespace

EdgePolynomial::EdgePolynomial(std::vector<Exact> coefficients) : coefficients_(std::move(coefficients)) {
  while (!coefficients_.empty() && coefficients_.back() == 0) coefficients_.pop_back();
}

Exact EdgePolynomial::at(const Exact& s) const {
  Exact sum = 0;
  for (auto c = coefficients_.rbegin(); c != coefficients_.rend(); ++c) sum = sum * s + *c;
  return sum;
}

double EdgePolynomial::at(double s) const {
  double sum = 0.0;
  for (auto c = coefficients_.rbegin(); c != coefficients_.rend(); ++c) sum = sum * s + rounded(*c);
  return sum;
}

EdgePolynomial EdgePolynomial::derivative() const {
  std::vector<Exact> out;
  for (int k = 1; k <= degree(); ++k) out.push_back(coefficients_[index(k)] * k);
  return EdgePolynomial(std::move(out));
}

EdgePolynomial operator+(const EdgePolynomial& a, const EdgePolynomial& b) {
  std::vector<Exact> out(std::max(a.coefficients_.size(), b.coefficients_.size()));
  for (std::size_t k = 0; k < a.coefficients_.size(); ++k) out[k] += a.coefficients_[k];
  for (std::size_t k = 0; k < b.coefficients_.size(); ++k) out[k] += b.coefficients_[k];
  return EdgePolynomial(std::move(out));
}

EdgePolynomial operator-(const EdgePolynomial& a, const EdgePolynomial& b) {
  return a + b * EdgePolynomial(-1);
}

EdgePolynomial operator*(const EdgePolynomial& a, const EdgePolynomial& b) {
  if (a.zero() || b.zero()) return {};
  std::vector<Exact> out(a.coefficients_.size() + b.coefficients_.size() - 1);
  for (std::size_t i = 0; i < a.coefficients_.size(); ++i) {
    for (std::size_t j = 0; j < b.coefficients_.size(); ++j)
      out[i + j] += a.coefficients_[i] * b.coefficients_[j];
  }
  return EdgePolynomial(std::move(out));
}

EdgePolynomial power(const EdgePolynomial& p, int exponent) {
  EdgePolynomial out = 1;
  for (int k = 0; k < exponent; ++k) out = out * p;
  return out;
}

EdgePolynomial linear(const Exact& c0, const Exact& c1) {
  std::vector<Exact> c(2);
  c[0] = c0, c[1] = c1;
  return EdgePolynomial(std::move(c));
}

EdgePolynomial bernstein_polynomial(int n, int k) {
  return EdgePolynomial(Exact(exact_binomial(n, k))) * power(linear(1, -1), n - k) * power(linear(0, 1), k);
}

EdgePolynomial from_bernstein(const std::vector<Exact>& coefficients) {
  const int n = static_cast<int>(coefficients.size()) - 1;
  EdgePolynomial out;
  for (int k = 0; k <= n; ++k) {
    out = out + EdgePolynomial(coefficients[index(k)]) * bernstein_polynomial(n, k);
  }
  return out;
}

// s^k = sum over j of C(j, k) / C(n, k) B_j.
std::vector<Exact> bernstein_coefficients(const EdgePolynomial& p, int degree) {
  std::vector<Exact> out(index(degree + 1));
  for (int k = 0; k <= p.degree(); ++k) {
    const Exact& c = p.coefficients()[index(k)];
    if (c == 0) continue;
    for (int j = k; j <= degree; ++j)
      out[index(j)] += c * Exact(exact_binomial(j, k), exact_binomial(degree, k));
  }
  return out;
}

EdgePolynomial compose(const EdgePolynomial& p, int n, const EdgePolynomial& a, const EdgePolynomial& b) {
  EdgePolynomial out;
  for (int k = 0; k <= p.degree(); ++k) {
    out = out + EdgePolynomial(p.coefficients()[index(k)]) * power(a, k) * power(b, n - k);
  }
  return out;
}

std::optional<Exact> not_positive(const EdgePolynomial& p) {
  if (p.zero()) return Exact(0);
  return not_positive(bernstein_coefficients(p, p.degree()), 0, 1, 50);
}

namespace {

// Constant denominators are moved into the numerator.
EdgeFunction tidy(EdgePolynomial numerator, EdgePolynomial denominator) {
  if (numerator.zero()) return {EdgePolynomial(), 1};
  if (denominator.degree() == 0) {
    return {numerator * EdgePolynomial(Exact(1) / denominator.coefficients()[0]), 1};
  }
  return {std::move(numerator), std::move(denominator)};
}

bool same(const EdgePolynomial& a, const EdgePolynomial& b) { return (a - b).zero(); }

}  // namespace

EdgeFunction operator+(const EdgeFunction& a, const EdgeFunction& b) {
  if (same(a.denominator, b.denominator)) return tidy(a.numerator + b.numerator, a.denominator);
  return tidy(a.numerator * b.denominator + b.numerator * a.denominator, a.denominator * b.denominator);
}

EdgeFunction operator-(const EdgeFunction& a, const EdgeFunction& b) { return a + b * EdgeFunction(-1); }

EdgeFunction operator*(const EdgeFunction& a, const EdgeFunction& b) {
  return tidy(a.numerator * b.numerator, a.denominator * b.denominator);
}

EdgeFunction operator/(const EdgeFunction& a, const EdgeFunction& b) {
  return tidy(a.numerator * b.denominator, a.denominator * b.numerator);
}

EdgeFunction derivative(const EdgeFunction& f) {
  return tidy(f.numerator.derivative() * f.denominator - f.numerator * f.denominator.derivative(),
              f.denominator * f.denominator);
}

EdgeFunction compose(const EdgeFunction& f, const EdgeFunction& map) {
  const int n = std::max({f.numerator.degree(), f.denominator.degree(), 0});
  return tidy(compose(f.numerator, n, map.numerator, map.denominator),
              compose(f.denominator, n, map.numerator, map.denominator));
}

}  // namespace rondure
