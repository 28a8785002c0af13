#include "renderer/bezier/gauss_rule.h"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/legendre.hpp>
#include <mutex>

#include "renderer/bezier/bernstein.h"

namespace rondure {
namespace {

// All B_k^n(t), by the recurrence in the degree: only convex combinations.
std::vector<long double> bernstein(int n, long double t) {
  std::vector<long double> b(static_cast<std::size_t>(n) + 1, 0.0L);
  b[0] = 1.0L;
  for (int d = 1; d <= n; ++d) {
    for (int k = d; k >= 0; --k) {
      const auto at = static_cast<std::size_t>(k);
      b[at] = (k < d ? (1.0L - t) * b[at] : 0.0L) + (k > 0 ? t * b[at - 1] : 0.0L);
    }
  }
  return b;
}

// The fewest nodes: with them the integrals over a small patch are done without subdivision.
constexpr int fewest = 10;

GaussRule make_rule(int degree) {
  GaussRule rule;
  rule.degree = degree;
  rule.count = std::max(3 * degree + 1, fewest);
  std::vector<long double> x = boost::math::legendre_p_zeros<long double>(rule.count);  // those not negative
  const bool odd = rule.count % 2 != 0;
  std::vector<long double> all;
  for (std::size_t k = x.size(); k-- > (odd ? 1u : 0u);) all.push_back(-x[k]);
  all.insert(all.end(), x.begin(), x.end());
  for (const long double z : all) {
    const long double slope = boost::math::legendre_p_prime(rule.count, z);
    rule.node.push_back(0.5L * (1.0L + z));
    rule.weight.push_back(1.0L / ((1.0L - z) * (1.0L + z) * slope * slope));
    for (const long double b : bernstein(degree, rule.node.back())) rule.value.push_back(b);
    for (const long double b : bernstein(degree - 1, rule.node.back())) rule.lower.push_back(b);
  }
  for (int k = 0; k < rule.count; ++k) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      rule.project.push_back(static_cast<double>(static_cast<long double>(2 * k + 1) * rule.weight[i] *
                                                 boost::math::legendre_p(k, all[i])));
    }
  }
  return rule;
}

}  // namespace

const GaussRule& gauss_rule(int degree) {
  static std::array<std::once_flag, max_degree + 1> made;
  static std::array<GaussRule, max_degree + 1> rules;
  const auto at = static_cast<std::size_t>(degree);
  std::call_once(made[at], [&] { rules[at] = make_rule(degree); });
  return rules[at];
}

}  // namespace rondure
