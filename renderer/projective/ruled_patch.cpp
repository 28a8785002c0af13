#include "renderer/projective/ruled_patch.h"

#include <algorithm>
#include <cmath>

#include "renderer/bezier/quotient.h"

namespace rondure {
namespace {

// Numbers below this, of vectors of length 1, are zero.
constexpr long double coincident = 1e-12L;

long double plane_det(const lvec2& p, const lvec2& q) { return p.x * q.y - p.y * q.x; }

RuledPoint times(const lvec2& factor, const RuledPoint& p) { return {factor.x * p.a, factor.y * p.b}; }

RuledPoint plus(const RuledPoint& p, const RuledPoint& q) { return {p.a + q.a, p.b + q.b}; }

lvec2 root(const lvec2& positive, long double n) {
  return {std::pow(positive.x, 1 / n), std::pow(positive.y, 1 / n)};
}

SectionArc balanced(long double s, long double t) {
  const long double size = std::sqrt(std::abs(s * t));
  return {s / size, t / size};
}

// The least of a quadratic with positive ends, c0 (1 - t)^2 + 2 c1 t (1 - t) + c2 t^2, is positive for
// middle > -1.
long double middle_weight(const RuledPoint& p, const RuledPoint& q, const lvec4& weight) {
  const long double c0 = glm::dot(weight, ruled_point(p.a, p.b)),
                    c2 = glm::dot(weight, ruled_point(q.a, q.b));
  if (!(c0 * c2 > 0)) return -INFINITY;
  const long double c1 = glm::dot(weight, ruled_point(p.a, q.b) + ruled_point(q.a, p.b)) / 2;
  return c1 / (c0 > 0 ? std::sqrt(c0 * c2) : -std::sqrt(c0 * c2));
}

}  // namespace

lvec4 to_preimage(const RuledPoint& p) { return {p.a.x, p.a.y, p.b.y, p.b.x}; }

lvec4 ruled_point(const lvec2& a, const lvec2& b) {
  return {a.x * b.x - a.y * b.y, a.y * b.x + a.x * b.y, a.y * b.x - a.x * b.y, a.x * b.x + a.y * b.y};
}

RuledPoint ruled_preimage(const lvec4& x) {
  // The products a_i b_j; the larger row and column have most of their digits.
  const lvec2 rows[2] = {{x.w + x.x, x.y - x.z}, {x.y + x.z, x.w - x.x}};
  const lvec2 columns[2] = {{rows[0].x, rows[1].x}, {rows[0].y, rows[1].y}};
  const auto longer = [](const lvec2(&v)[2]) {
    return glm::normalize(glm::dot(v[0], v[0]) >= glm::dot(v[1], v[1]) ? v[0] : v[1]);
  };
  return {longer(columns), longer(rows)};
}

SectionArc section_through(const RuledPoint& p, const RuledPoint& r, const RuledPoint& q) {
  // Both coordinates point to r at t = 1/2.
  return balanced(-quotient(plane_det(r.a, p.a), plane_det(r.a, q.a)),
                  -quotient(plane_det(r.b, p.b), plane_det(r.b, q.b)));
}

std::optional<SectionArc> section_in_plane(const RuledPoint& p, const RuledPoint& q, const lvec4& h,
                                           const lvec4& weight) {
  lvec2 arc(glm::dot(p.a, q.a) < 0 ? -1 : 1, glm::dot(p.b, q.b) < 0 ? -1 : 1);
  const bool same_a = std::abs(plane_det(p.a, q.a)) < coincident,
             same_b = std::abs(plane_det(p.b, q.b)) < coincident;
  lvec2 other = -arc;
  if (same_a || same_b) {
    // The line's own coordinate must not change its sign.
    if (same_a) other.x = arc.x;
    if (same_b) other.y = arc.y;
  } else {
    const long double s = glm::dot(h, ruled_point(p.a, q.b)), t = -glm::dot(h, ruled_point(q.a, p.b));
    const long double least = coincident * glm::length(h);
    if (!(std::abs(s) > least) || !(std::abs(t) > least)) return std::nullopt;
    // a.x dot(h, q.a p.b) + a.y dot(h, p.a q.b) = 0
    arc = balanced(s, t);
    other = -arc;
  }
  const long double in_arc = middle_weight(p, times(arc, q), weight);
  const long double in_other = middle_weight(p, times(other, q), weight);
  if (!(std::max(in_arc, in_other) > -1)) return std::nullopt;
  return in_arc >= in_other ? arc : other;
}

lvec2 holonomy(const RuledQuad& quad) { return quad.arc[0] * quad.arc[1] * quad.arc[2] * quad.arc[3]; }

TensorPreimage bilinear_preimage(const RuledQuad& quad) {
  const lvec2 less = 1.0L / root(holonomy(quad), 4);
  TensorPreimage p(1, 1);
  lvec4* const at[] = {&p.at(0, 0), &p.at(1, 0), &p.at(1, 1), &p.at(0, 1)};
  lvec2 factor(1);
  for (std::size_t k = 0; k < 4; ++k) {
    *at[k] = to_preimage(times(factor, quad.corner[k]));
    factor *= quad.arc[k] * less;
  }
  return p;
}

TensorPreimage linear_quadratic_preimage(const RuledQuad& quad) {
  // As on the sphere: straight sides u = 0 and u = 1 from v = 0, each times a linear factor.
  const auto& [corner, g] = quad;
  const lvec2 h = holonomy(quad), c = root(h, 2), factor[2] = {c, c / h};
  const RuledPoint low[2] = {corner[0], times(g[0], corner[1])};
  const RuledPoint high[2] = {times(1.0L / g[3], corner[3]), times(g[0] * g[1], corner[2])};
  TensorPreimage p(1, 2);
  for (int i = 0; i < 2; ++i) {
    p.at(i, 0) = to_preimage(low[i]);
    p.at(i, 1) = to_preimage(times(lvec2(0.5L), plus(high[i], times(factor[i], low[i]))));
    p.at(i, 2) = to_preimage(times(factor[i], high[i]));
  }
  return p;
}

TensorPreimage quadratic_linear_preimage(const RuledQuad& quad) {
  const auto& [corner, g] = quad;
  const TensorPreimage from =
      linear_quadratic_preimage({{corner[1], corner[2], corner[3], corner[0]}, {g[1], g[2], g[3], g[0]}});
  TensorPreimage p(2, 1);
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; j <= 1; ++j) p.at(i, j) = from.at(j, 2 - i);
  }
  return p;
}

bool is_regular_ruled(const TensorPreimage& p) {
  // The Jacobian of the two lines' parameters, times squares.
  using Pairs = TensorPolynomial<lvec2>;
  const int m = p.m, n = p.n;
  Pairs a(m, n), b(m, n), a_u(m - 1, n), b_u(m - 1, n), a_v(m, n - 1), b_v(m, n - 1);
  for (int i = 0; i <= m; ++i) {
    for (int j = 0; j <= n; ++j) {
      const lvec4& c = p.at(i, j);
      a.at(i, j) = {c[0], c[1]}, b.at(i, j) = {c[3], c[2]};
    }
  }
  const auto difference = [](const Pairs& from, Pairs& to, int di, int dj) {
    for (int i = 0; i <= to.m; ++i) {
      for (int j = 0; j <= to.n; ++j)
        to.at(i, j) =
            static_cast<long double>(di == 1 ? from.m : from.n) * (from.at(i + di, j + dj) - from.at(i, j));
    }
  };
  difference(a, a_u, 1, 0), difference(a, a_v, 0, 1);
  difference(b, b_u, 1, 0), difference(b, b_v, 0, 1);
  const auto turn = [](const Pairs& f, const Pairs& g) { return multiply(f, g, plane_det); };
  const auto jacobian =
      add_scaled(multiply(turn(a_u, a), turn(b_v, b)), multiply(turn(a_v, a), turn(b_u, b)), -1.0L);
  const auto [low, high] = std::minmax_element(jacobian.coefficients.begin(), jacobian.coefficients.end());
  const long double rounding = 1e-15L * std::max(std::abs(*low), std::abs(*high));
  return (*low >= -rounding && *high > rounding) || (*high <= rounding && *low < -rounding);
}

}  // namespace rondure
