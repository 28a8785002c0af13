// Roots of Bernstein polynomials against those they were made from.
#include "renderer/bezier/bernstein_roots.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// Scaled coefficients of the product of t - root, in quadruple the rounding of none: products of (-root, 1 -
// root).
std::vector<double> polynomial(const std::vector<double>& roots) {
  std::vector<long double> c{1.0L};
  for (const double r : roots) {
    std::vector<long double> next(c.size() + 1, 0.0L);
    for (std::size_t k = 0; k < c.size(); ++k) {
      next[k] -= static_cast<long double>(r) * c[k];
      next[k + 1] += (1.0L - static_cast<long double>(r)) * c[k];
    }
    c = next;
  }
  return {c.begin(), c.end()};
}

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

BernsteinRoots roots_of(const std::vector<double>& scaled, double noise) {
  BernsteinRoots out;
  const int n = static_cast<int>(scaled.size()) - 1;
  if (n == 3)
    bernstein_roots<3>(n, scaled.data(), noise, out);
  else
    bernstein_roots<dynamic>(n, scaled.data(), noise, out);
  return out;
}

}  // namespace

TEST_CASE("every simple root is found once, and no other", "[roots]") {
  std::mt19937_64 random(5);
  WorstCase worst;
  int wrong = 0, total = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<double> given, inside;
    const int n = 1 + trial % 9;
    while (static_cast<int>(given.size()) < n) {
      const double r = uniform(random, -1.0, 2.0);
      // Apart from each other and from the ends, so that their number is certain.
      bool apart = std::min(std::fabs(r), std::fabs(r - 1.0)) > 1e-3;
      for (const double other : given) apart = apart && std::fabs(r - other) > 1e-3;
      if (apart) given.push_back(r);
    }
    for (const double r : given)
      if (r > 0.0 && r < 1.0) inside.push_back(r);
    std::sort(inside.begin(), inside.end());
    const BernsteinRoots found = roots_of(polynomial(given), 0.0);
    wrong += found.count != static_cast<int>(inside.size());
    for (int k = 0; k < std::min(found.count, static_cast<int>(inside.size())); ++k, ++total) {
      const BernsteinRoot& root = found.items[static_cast<std::size_t>(k)];
      wrong += !root.simple;
      // 1e-9 of the interval, as promised; rounding (1e-16) over products of distances of 1e-3 is less for
      // most.
      worst.add(std::fabs(root.t - inside[static_cast<std::size_t>(k)]), 1e-8,
                [&] { return fmt::format("degree {}, root {}", n, root.t); });
    }
  }
  INFO(worst.text());
  CHECK(wrong == 0);
  CHECK(total > 3000);
  CHECK(worst.failures() == 0);
}

TEST_CASE("double roots are found, and what keeps away by more than the noise is not", "[roots]") {
  std::mt19937_64 random(6);
  int missed = 0, false_roots = 0, split = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const double r = uniform(random, 0.01, 0.99);
    const int n = 2 + trial % 5;
    std::vector<double> given{r, r};
    while (static_cast<int>(given.size()) < n) given.push_back(uniform(random, 1.5, 3.0));
    std::vector<double> c = polynomial(given);
    const double noise = 1e-14;
    const auto near = [&](const BernsteinRoots& roots) {
      // Within the noise the parabola is indistinguishable from one that touches: sqrt(noise), and a factor
      // of the other roots' distances, at least 0.5 each.
      bool found = false;
      for (const BernsteinRoot& root : roots) found = found || std::fabs(root.t - r) < 1e-5;
      return found;
    };
    missed += !near(roots_of(c, noise));
    // The sign of the others' product is that of (-1)^(n - 2): away from zero by 100 noises, and towards it.
    const double away = (n % 2 == 0 ? 1.0 : -1.0) * 100.0 * noise;
    std::vector<double> up = c, down = c;
    for (int k = 0; k <= n; ++k) {
      up[static_cast<std::size_t>(k)] += away * binomial(n, k);
      down[static_cast<std::size_t>(k)] -= away * binomial(n, k);
    }
    false_roots += roots_of(up, noise).count;
    split += roots_of(down, noise).count == 2;
  }
  CHECK(missed == 0);
  CHECK(false_roots == 0);
  CHECK(split == 500);
}

TEST_CASE("roots at the ends are found", "[roots]") {
  for (const double r : {0.0, 1.0}) {
    for (int n = 1; n <= 6; ++n) {
      std::vector<double> given{r};
      while (static_cast<int>(given.size()) < n) given.push_back(2.0 + 0.1 * n);
      // Beyond the end by less than the noise, on it, and inside.
      for (const double shift : {-1e-15, 0.0, 1e-15}) {
        std::vector<double> c = polynomial(given);
        c[r == 0.0 ? 0 : static_cast<std::size_t>(n)] += shift;
        const BernsteinRoots found = roots_of(c, 1e-14);
        INFO("degree " << n << " at " << r << " by " << shift);
        REQUIRE(found.count >= 1);
        CHECK(std::fabs(found.items[0].t - r) < 1e-9);
      }
    }
  }
}

// A parabola's two roots on either side of an end where it is no deeper than the noise: the inner one counts.
TEST_CASE("Noise at an end does not hide a root beside it", "[roots]") {
  std::mt19937_64 random(7);
  int lost = 0, total = 0;
  std::string worst = "none";
  for (int trial = 0; trial < 20'000; ++trial) {
    const double root = std::pow(10.0, uniform(random, -8.0, -2.0));
    const double outside = -root * std::pow(10.0, uniform(random, -2.0, 2.0));
    std::vector<double> given{root, outside};
    const int n = 2 + trial % 5;
    while (static_cast<int>(given.size()) < n) given.push_back(uniform(random, 1.5, 3.0));
    std::vector<double> c = polynomial(given);
    const double noise = std::fabs(c[0]) * std::pow(10.0, uniform(random, -1.0, 3.0));
    const bool high = trial % 2 == 1;
    if (high) std::reverse(c.begin(), c.end());
    const double place = high ? 1.0 - root : root;
    bool found = false;
    // 1e-9 as promised for simple roots; others lie within what they say that the noise hides.
    for (const BernsteinRoot& r : roots_of(c, noise))
      found = found || std::fabs(r.t - place) <= std::max(r.width, 1e-9);
    ++total, lost += !found;
    if (!found) worst = fmt::format("degree {}, root {}, the other {}, noise {}", n, place, outside, noise);
  }
  INFO(lost << " of " << total << " roots; the last: " << worst);
  CHECK(lost == 0);
  // In the middle alone, between ends that are alike.
  CHECK(roots_of({1.0, 0.0, 1.0}, 0.1).count == 0);
}

}  // namespace rondure
