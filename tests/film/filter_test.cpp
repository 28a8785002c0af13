#include "renderer/film/filter.h"

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// The filters as they are defined, unnormalised, on [-r, r].
double value(FilterKind kind, double r, double x) {
  const double a = std::numbers::pi * x / r;
  switch (kind) {
    case FilterKind::box:
      return 1.0;
    case FilterKind::tent:
      return 1.0 - std::abs(x) / r;
    case FilterKind::gaussian:
      return std::exp(-4.5 * x * x / (r * r));  // deviation r / 3
    case FilterKind::blackman_harris:
      return 0.35875 + 0.48829 * std::cos(a) + 0.14128 * std::cos(2 * a) + 0.01168 * std::cos(3 * a);
  }
  return 0.0;
}

// Simpson's rule.
double integral(const std::function<double(double)>& f, double a, double b) {
  constexpr int n = 400;
  double sum = f(a) + f(b);
  for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(a + (b - a) * i / n);
  return sum * (b - a) / (3.0 * n);
}

TEST_CASE("filters draw offsets from their own distribution", "[film]") {
  for (const FilterKind kind :
       {FilterKind::box, FilterKind::tent, FilterKind::gaussian, FilterKind::blackman_harris}) {
    for (const double radius : {0.0, 3.0}) {
      const Filter filter(kind, radius);
      const double r = filter.radius();
      const auto f = [&](double x) { return value(kind, r, x); };
      const double whole = integral(f, -r, 0.0) + integral(f, 0.0, r);
      WorstCase exact, drawn;
      for (int i = 0; i <= 200; ++i) {
        const double x = r * (i / 100.0 - 1.0);
        const double share =
            (x < 0 ? integral(f, -r, x) : integral(f, -r, 0.0) + integral(f, 0.0, x)) / whole;
        // Simpson's error: (pi / 400)^4 / 180 times fourth derivatives of order (3 pi)^4 in r: below 1e-8.
        exact.add(std::abs(filter.cumulative(x) - share), 1e-8, [&] { return std::to_string(x); });
      }
      double last = -r;
      for (int i = 0; i < 5000; ++i) {
        const double u = (i + 0.5) / 5000;
        const dvec2 p = filter.sample({u, 1.0 - u});
        // Linear interpolation of the distribution between knots r / 1024 apart: error h^2 / 8 times a slope
        // of the density that stays below 10 / r^2 for these filters: 1.2e-6.
        drawn.add(std::abs(filter.cumulative(p.x) - u), 1.2e-6, [&] { return std::to_string(u); });
        drawn.add(std::abs(p.x + p.y), 1e-12, [&] { return "symmetry " + std::to_string(u); });
        drawn.add(p.x >= last && p.x <= r ? 0.0 : 1.0, 0.5, [&] { return "order " + std::to_string(u); });
        last = p.x;
      }
      INFO(filter.name() << ": " << exact.text() << "\n" << drawn.text());
      CHECK(exact.failures() == 0);
      CHECK(drawn.failures() == 0);
    }
  }
}

}  // namespace
}  // namespace rondure
