#include "renderer/normals/normal_germ.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "renderer/bezier/angle.h"
#include "renderer/bezier/curvature_polynomial.h"
#include "renderer/bezier/edge_factor.h"
#include "renderer/normals/direction.h"

namespace rondure {
namespace {

// The normal polynomial without its sides' factors, and how often each of u, 1 - u, v, 1 - v (u, v, w) was
// one.
struct Reduced {
  NormalPolynomial polynomial;
  int side_order = 0;  // of the sides through the point
};

// How often the power of t at the end t = 0 or t = 1 divides a factor that is a product of such powers: its
// Bernstein coefficients along that direction vanish up to there.
template <class Present>
int leading_zeros(int count, Present present) {
  int zeros = 0;
  while (zeros < count && !present(zeros)) ++zeros;
  return zeros;
}

Reduced reduced_at(const Net& net, dvec2 at) {
  NormalPolynomial whole = normal_directions(net);
  if (auto* tensor = std::get_if<TensorNormal>(&whole)) {
    TensorPolynomial<double> factor;
    factor.coefficients = {1.0};
    Reduced r{without_edges(*tensor, factor)};
    const auto row = [&](int i) {
      for (int j = 0; j <= factor.n; ++j)
        if (factor.at(i, j) != 0.0) return true;
      return false;
    };
    const auto column = [&](int j) {
      for (int i = 0; i <= factor.m; ++i)
        if (factor.at(i, j) != 0.0) return true;
      return false;
    };
    if (at.x == 0.0) r.side_order += leading_zeros(factor.m, row);
    if (at.x == 1.0) r.side_order += leading_zeros(factor.m, [&](int k) { return row(factor.m - k); });
    if (at.y == 0.0) r.side_order += leading_zeros(factor.n, column);
    if (at.y == 1.0) r.side_order += leading_zeros(factor.n, [&](int k) { return column(factor.n - k); });
    return r;
  }
  TrianglePolynomial<double> factor;
  factor.coefficients = {1.0};
  Reduced r{without_edges(std::get<TriangleNormal>(whole), factor)};
  const int n = factor.n;
  const bool on[3] = {at.x == 0.0, at.y == 0.0, at.x + at.y == 1.0};
  for (int c = 0; c < 3; ++c) {
    int least = n;
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n - i; ++j) {
        const int power[3] = {i, j, n - i - j};
        if (factor.at(i, j) != 0.0) least = std::min(least, power[c]);
      }
    }
    if (on[c]) r.side_order += least;
  }
  return r;
}

struct Term {
  int a, b;  // powers of the two coordinates that vanish at the corner
  dvec3 coefficient;
};

// The Bernstein form as seen from a corner: near it a coefficient is that of its power of the two
// coordinates, up to a positive factor. Empty when the point is no corner.
std::vector<Term> terms_at_corner(const NormalPolynomial& p, dvec2 at) {
  std::vector<Term> terms;
  const auto end = [](double x) { return x == 0.0 || x == 1.0; };
  if (const auto* t = std::get_if<TensorNormal>(&p)) {
    if (!end(at.x) || !end(at.y)) return {};
    for (int i = 0; i <= t->m; ++i)
      for (int j = 0; j <= t->n; ++j)
        terms.push_back({at.x == 0.0 ? i : t->m - i, at.y == 0.0 ? j : t->n - j, t->at(i, j)});
    return terms;
  }
  const auto& t = std::get<TriangleNormal>(p);
  if (!end(at.x) || !end(at.y)) return {};
  for (int i = 0; i <= t.n; ++i) {
    for (int j = 0; j <= t.n - i; ++j) {
      const int k = t.n - i - j;
      if (at.x == 1.0)
        terms.push_back({j, k, t.at(i, j)});
      else if (at.y == 1.0)
        terms.push_back({i, k, t.at(i, j)});
      else
        terms.push_back({i, j, t.at(i, j)});
    }
  }
  return terms;
}

// Of terms that are a limit's in some way into the corner: those on the lower left hull of the powers
// (Newton's polygon). There is one limit if they are positive multiples of one direction; where some are not,
// the sums that belong to a slope of the hull may still be.
NormalGerm germ_at_corner(std::vector<Term> terms) {
  NormalGerm germ;
  double largest = 0.0;
  for (const Term& t : terms) largest = std::max(largest, glm::length(t.coefficient));
  std::erase_if(terms, [&](const Term& t) { return !(glm::length(t.coefficient) > 1e-13 * largest); });
  if (terms.empty()) return germ;
  germ.order = terms.front().a + terms.front().b;
  for (const Term& t : terms) germ.order = std::min(germ.order, t.a + t.b);
  dvec3 sum(0.0);
  std::vector<dvec3> limits;
  // A way in is (t^q x, t^p y), x and y positive; its limit is the sum of the terms least in q a + p b.
  constexpr int slopes[][2] = {{1, 1}, {1, 2}, {2, 1}, {1, 3}, {3, 1}, {2, 3}, {3, 2}, {1, 16}, {16, 1}};
  for (const auto& s : slopes) {
    int least = 1 << 20;
    for (const Term& t : terms) least = std::min(least, s[0] * t.a + s[1] * t.b);
    for (const double x : {1e-3, 0.3, 1.0, 3.0, 1e3}) {
      dvec3 value(0.0);
      for (const Term& t : terms)
        if (s[0] * t.a + s[1] * t.b == least) value += t.coefficient * std::pow(x, t.a);
      if (const auto way = direction_of(value)) limits.push_back(*way);
    }
  }
  for (const dvec3& way : limits) {
    sum += way;
    for (const dvec3& other : limits) germ.spread = std::max(germ.spread, angle_between(way, other));
  }
  germ.has_limit = germ.spread < 1e-7;
  return germ;
}

double inside(const Net& net, dvec2 p) {
  if (std::holds_alternative<TensorNet>(net)) return std::min({p.x, p.y, 1.0 - p.x, 1.0 - p.y});
  return std::min({p.x, p.y, 1.0 - p.x - p.y});
}

// Elsewhere rounding ends the way in: the change of the direction between two distances has to do.
NormalGerm germ_by_ways(const Net& net, const NormalPolynomial& p, dvec2 at) {
  NormalGerm germ;
  double near = 0x1p-14, spread[2] = {0.0, 0.0}, size[2] = {0.0, 0.0};
  for (int step = 0; step < 2; ++step, near *= 0.5) {
    std::vector<dvec3> ways;
    for (int k = 0; k < 16; ++k) {
      const double angle = (k + 0.37) * std::numbers::pi / 8.0;
      const dvec2 there = at + near * dvec2(std::cos(angle), std::sin(angle));
      if (!(inside(net, there) >= 0.0)) continue;
      const dvec3 value = polynomial_value(p, there.x, there.y);
      size[step] = std::max(size[step], glm::length(value));
      if (const auto way = direction_of(value)) ways.push_back(*way);
    }
    for (const dvec3& a : ways)
      for (const dvec3& b : ways) spread[step] = std::max(spread[step], angle_between(a, b));
  }
  if (!(size[1] > 0.0)) return germ;
  germ.order = static_cast<int>(std::lround(std::log2(size[0] / size[1])));
  germ.has_limit = spread[1] < 1e-6 || spread[1] < 0.75 * spread[0];
  germ.spread = germ.has_limit ? 0.0 : spread[1];
  return germ;
}

}  // namespace

NormalGerm germ_of(const Net& net, dvec2 at) {
  const Reduced reduced = reduced_at(net, at);
  const std::vector<Term> terms = terms_at_corner(reduced.polynomial, at);
  NormalGerm germ = terms.empty() ? germ_by_ways(net, reduced.polynomial, at) : germ_at_corner(terms);
  germ.side_order = reduced.side_order;
  return germ;
}

}  // namespace rondure
