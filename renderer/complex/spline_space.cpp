#include "renderer/complex/spline_space.h"

#include <algorithm>
#include <tuple>

#include "renderer/bezier/index.h"

namespace rondure {
namespace {

int steps_from_corner(int sides, int n, int coefficient) {
  const auto e = exponents_of(sides, n, coefficient);
  if (sides == 3) return n - std::max({e[0], e[1], e[2]});
  return std::min(e[0], n - e[0]) + std::min(e[1], n - e[1]);
}

}  // namespace

std::vector<int> elimination_order(const SurfaceComplex& complex, int n) {
  std::vector<std::tuple<int, int, int>> keys;
  int number = 0;
  for (const int sides : complex.sides) {
    for (int k = 0; k < coefficient_count(sides, n); ++k) {
      keys.emplace_back(steps_from_boundary(sides, n, k), steps_from_corner(sides, n, k), number++);
    }
  }
  std::sort(keys.begin(), keys.end());
  std::vector<int> order;
  for (const auto& key : keys) order.push_back(std::get<2>(key));
  return order;
}

SplineSpace spline_space(const SurfaceComplex& complex, int n, std::vector<PolygonPolynomial> denominators) {
  SplineSpace space{n, coefficient_offsets(complex, n), std::move(denominators), {}};
  const std::vector<SparseRow> rows = gc1_conditions(complex, n, space.denominators);
  const std::vector<int> order = elimination_order(complex, n);
  space.solutions = complex.exact ? exact_null_space(rows, order) : rounded_null_space(rows, order);
  return space;
}

PolygonPolynomial numerator_of(const SurfaceComplex& complex, const SplineSpace& space, std::size_t function,
                               int polygon) {
  const int sides = complex.sides[index(polygon)];
  PolygonPolynomial p{sides, space.degree, std::vector<Exact>(index(coefficient_count(sides, space.degree)))};
  const int begin = space.offsets[index(polygon)], end = space.offsets[index(polygon) + 1];
  for (const auto& [unknown, value] : space.solutions.basis[function]) {
    if (unknown >= begin && unknown < end) p.coefficients[index(unknown - begin)] = value;
  }
  return p;
}

std::vector<int> support_of(const SplineSpace& space, std::size_t function) {
  std::vector<int> polygons;
  for (const auto& entry : space.solutions.basis[function]) {
    const auto after = std::upper_bound(space.offsets.begin(), space.offsets.end(), entry.first);
    const int polygon = static_cast<int>(after - space.offsets.begin()) - 1;
    if (polygons.empty() || polygons.back() != polygon) polygons.push_back(polygon);
  }
  return polygons;
}

}  // namespace rondure
