#include "renderer/complex/fit.h"

#include "renderer/bezier/index.h"
#include "renderer/bezier/least_squares.h"

namespace rondure {

CoefficientTargets flat_targets(const SurfaceComplex& complex, int n,
                                const std::vector<std::vector<dvec3>>& corners) {
  CoefficientTargets targets;
  for (std::size_t p = 0; p < complex.sides.size(); ++p) {
    const int sides = complex.sides[p];
    const std::vector<dvec3>& c = corners[p];
    std::vector<dvec3> points;
    for (int k = 0; k < coefficient_count(sides, n); ++k) {
      const auto e = exponents_of(sides, n, k);
      const double a = static_cast<double>(e[0]) / n, b = static_cast<double>(e[1]) / n;
      points.push_back(sides == 3
                           ? a * c[0] + b * c[1] + (1.0 - a - b) * c[2]
                           : (1.0 - b) * ((1.0 - a) * c[0] + a * c[1]) + b * ((1.0 - a) * c[3] + a * c[2]));
    }
    targets.push_back(std::move(points));
  }
  return targets;
}

std::vector<BlendPoint> fitted_points(const GcBasis& basis, const CoefficientTargets& targets) {
  std::size_t rows = 0;
  for (const auto& polygon : targets) rows += polygon.size();
  Matrix a(rows, basis.functions.size());
  std::vector<std::vector<double>> right(3);
  for (const auto& polygon : targets) {
    for (const dvec3& point : polygon) {
      for (int d = 0; d < 3; ++d) right[index(d)].push_back(point[d]);
    }
  }
  for (std::size_t k = 0; k < basis.functions.size(); ++k) {
    std::size_t row = 0;
    for (const PolygonPolynomial& p : basis.functions[k]) {
      for (const Exact& c : p.coefficients) a.at(row++, k) = c == 0 ? 0.0 : rounded(c);
    }
  }
  const std::vector<std::vector<double>> x = least_squares(std::move(a), std::move(right));
  std::vector<BlendPoint> points(basis.functions.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t d = 0; d < 3; ++d) points[k].point[d] = exact_of(x[d][k]);
  }
  return points;
}

}  // namespace rondure
