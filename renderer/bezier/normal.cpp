#include "renderer/bezier/normal.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/bezier/rational.h"

namespace rondure {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// How far inside the domain a limit is taken; its direction is off by about as much.
constexpr double inset = 0x1p-53;

dvec3 value_inside(const TensorPolynomial<dvec3>& p, double u, double v) {
  double bu[max_binomial_degree + 1], bv[max_binomial_degree + 1];
  bernstein_values(p.m, std::clamp(u, inset, 1.0 - inset), bu);
  bernstein_values(p.n, std::clamp(v, inset, 1.0 - inset), bv);
  dvec3 sum(0.0);
  for (int i = 0; i <= p.m; ++i) {
    for (int j = 0; j <= p.n; ++j) sum += (bu[i] * bv[j]) * p.at(i, j);
  }
  return sum;
}

dvec3 value_inside(const TrianglePolynomial<dvec3>& p, double u, double v) {
  const double a = std::max(u, inset);
  const double b = std::max(v, inset);
  const double c = std::max(1.0 - u - v, inset);
  std::vector<double> pb(static_cast<std::size_t>(p.n) + 1, 1.0), pc = pb;
  for (std::size_t k = 1; k < pb.size(); ++k) {
    pb[k] = pb[k - 1] * b;
    pc[k] = pc[k - 1] * c;
  }
  dvec3 sum(0.0);
  double pa = 1.0;
  for (int i = 0; i <= p.n; ++i) {
    for (int j = 0; j <= p.n - i; ++j) {
      const double powers = pb[static_cast<std::size_t>(j)] * pc[static_cast<std::size_t>(p.n - i - j)];
      sum += (trinomial(p.n, i, j) * pa * powers) * p.at(i, j);
    }
    pa *= a;
  }
  return sum;
}

double largest_component(const dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

dvec3 unit_or_zero(const dvec3& n) {
  // Scaled first: close to a singular point of high order the square of the length would underflow.
  const double largest = largest_component(n);
  if (!(largest > 0.0) || !std::isfinite(largest)) return dvec3(0.0);
  return glm::normalize(n / largest);
}

// The largest coordinate difference of a control point from the surface point at hand, weights included: the
// scale against which a tangent is short. Zero where it is only the rounding of the control points.
double spread(const Net& net, const dvec3& point) {
  double largest = 0.0, rounding = 0.0;
  for (const dvec4& p : points_of(net)) {
    largest = std::max(largest, largest_component(dvec3(p) - p.w * point));
    rounding = std::max(rounding, 8.0 * epsilon * largest_component(dvec3(p)));
  }
  return largest > rounding ? largest : 0.0;
}

struct Tangents {
  dvec3 point, a, b;  // a = w f_u, b = w f_v
};

Tangents tangents(const FirstOrder<dvec4>& f) {
  const dvec3 p = dvec3(f.value) / f.value.w;
  return {p, dvec3(f.du) - f.du.w * p, dvec3(f.dv) - f.dv.w * p};
}

// The size of the coordinates that the tangents are sums of, from the surface point and three control points
// far from one another: looking at all would take as long as the evaluation. The first and last are corners.
double magnitude(const Net& net, const FirstOrder<dvec4>& f) {
  const std::vector<dvec4>& points = points_of(net);
  const dvec4 ends = glm::max(glm::abs(points.front()), glm::abs(points.back()));
  const dvec4 inner = glm::max(glm::abs(points[points.size() / 2]), glm::abs(f.value));
  const dvec4 largest = glm::max(ends, inner);
  return largest.x + largest.y + largest.z;
}

int degree_of(const Net& net) {
  if (const auto* t = std::get_if<TensorNet>(&net)) return std::max(t->m, t->n);
  return std::get<TriangleNet>(net).n;
}

constexpr double singular = 1e-4;

// The cross product of the tangents in units of the net's spread, in which it neither overflows nor
// underflows.
dvec3 relative_cross(const Tangents& t, double scale) { return glm::cross(t.a / scale, t.b / scale); }

// The squares of lengths between these are neither subnormal nor infinite.
constexpr double shortest = 1e-145, longest = 1e150;

}  // namespace

dvec3 unit_normal(const Net& net, double u, double v, const FirstOrder<dvec4>& f) {
  const Tangents t = tangents(f);
  const dvec3 n = glm::cross(t.a, t.b);
  const double size = glm::length(n);
  // Rounding turns the cross product by about (error of a) |b| / |n| + |a| (error of b) / |n|. The tangents
  // are sums of control points, so their errors are relative to those, whatever the unit of length. The
  // comparison with `shortest` is what excludes tangents of length zero, where both sides would be zero.
  const double noise = 8.0 * epsilon * degree_of(net) * magnitude(net, f);
  if (noise * (glm::length(t.a) + glm::length(t.b)) <= 1e-11 * size && size > shortest && size < longest) {
    return n / size;
  }
  const double scale = spread(net, t.point);
  if (scale == 0.0) return dvec3(0.0);
  const dvec3 relative = relative_cross(t, scale);
  if (glm::length(relative) > singular) return glm::normalize(relative);
  const NormalPolynomial polynomial = normal_directions(net);
  const dvec3 limit = std::visit([&](const auto& p) { return value_inside(p, u, v); }, polynomial);
  return unit_or_zero(f.value.w < 0.0 ? -limit : limit);
}

dvec3 unit_normal(const Net& net, double u, double v) { return unit_normal(net, u, v, net_first(net, u, v)); }

Curvature curvature(const Net& net, double u, double v) {
  const Tangents t = tangents(net_first(net, u, v));
  const double scale = spread(net, t.point);
  if (!(glm::length(relative_cross(t, scale)) > singular)) {
    constexpr double step = 1e-4;
    if (std::holds_alternative<TensorNet>(net)) {
      u = std::clamp(u, step, 1.0 - step);
      v = std::clamp(v, step, 1.0 - step);
    } else {
      const double a = std::max(u, step), b = std::max(v, step), c = std::max(1.0 - u - v, step);
      u = a / (a + b + c);
      v = b / (a + b + c);
    }
  }
  const SurfaceJet s = surface_jet(net, u, v);
  const dvec3 n = unit_normal(net, u, v);
  const double e = glm::dot(s.du, s.du), f = glm::dot(s.du, s.dv), g = glm::dot(s.dv, s.dv);
  const double l = glm::dot(s.duu, n), m = glm::dot(s.duv, n), k = glm::dot(s.dvv, n);
  const double area = glm::dot(glm::cross(s.du, s.dv), glm::cross(s.du, s.dv));
  return {(l * k - m * m) / area, (e * k - 2.0 * f * m + g * l) / (2.0 * area)};
}

NormalCone cone_of(const dvec3* vectors, std::size_t count) {
  NormalCone cone;
  dvec3 sum(0.0);
  for (std::size_t k = 0; k < count; ++k) sum += unit_or_zero(vectors[k]);
  cone.axis = unit_or_zero(sum);
  if (cone.axis == dvec3(0.0)) return cone;
  double least = 1.0;
  for (std::size_t k = 0; k < count; ++k) {
    if (vectors[k] != dvec3(0.0)) least = std::min(least, glm::dot(cone.axis, unit_or_zero(vectors[k])));
  }
  // Directions in a cone of less than a half-space stay in it when they are added; in a wider one they do
  // not.
  cone.cos_angle = least > 0.0 ? std::max(least - 8.0 * epsilon, 0.0) : -1.0;
  return cone;
}

NormalCone normal_cone(const Net& net) {
  const NormalPolynomial polynomial = normal_directions(net);
  NormalCone cone = std::visit(
      [](const auto& p) { return cone_of(p.coefficients.data(), p.coefficients.size()); }, polynomial);
  // N carries the sign of w^3.
  if (points_of(net).front().w < 0.0) cone.axis = -cone.axis;
  return cone;
}

}  // namespace rondure
