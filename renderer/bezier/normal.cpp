#include "renderer/bezier/normal.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/quotient.h"
#include "renderer/bezier/rational.h"
#include "renderer/bezier/regular_normal.h"
#include "renderer/bezier/tangents_in.h"

namespace rondure {
namespace {

double largest_component(const dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// How far inside the domain a limit is taken: so little that of the normal polynomial only the terms of
// lowest order count, however unequal the weights, and not so little that those of order ten underflow.
constexpr double inset = 0x1p-100;

// The Bernstein polynomials of degree n at t, or `inset` inside where t is an end of [0, 1].
void values_inside(int n, double t, double* out) {
  const double a = std::max(t, inset), b = std::max(1.0 - t, inset);
  for (int k = 0; k <= n; ++k) out[k] = binomial(n, k) * std::pow(a, k) * std::pow(b, n - k);
}

struct SumOfTerms {
  dvec3 value{0.0};
  double terms = 0.0;  // sum of the sizes of what was added, coordinate by coordinate

  void add(double basis, const dvec3& coefficient) {
    value += basis * coefficient;
    terms += basis * (std::abs(coefficient.x) + std::abs(coefficient.y) + std::abs(coefficient.z));
  }
};

SumOfTerms sum_of(const TensorPolynomial<dvec3>& p, const double* bu, const double* bv) {
  SumOfTerms sum;
  for (int i = 0; i <= p.m; ++i) {
    for (int j = 0; j <= p.n; ++j) sum.add(bu[i] * bv[j], p.at(i, j));
  }
  return sum;
}

SumOfTerms evaluate(const TensorPolynomial<dvec3>& p, double u, double v) {
  double bu[max_binomial_degree + 1], bv[max_binomial_degree + 1];
  bernstein_values(p.m, u, bu);
  bernstein_values(p.n, v, bv);
  return sum_of(p, bu, bv);
}

// Calls visit(i, j, value) for the Bernstein polynomials of degree n in barycentric a, b, c.
template <class Visit>
void visit_basis(int n, double a, double b, double c, Visit&& visit) {
  std::vector<double> pb(static_cast<std::size_t>(n) + 1, 1.0), pc = pb;
  for (std::size_t k = 1; k < pb.size(); ++k) {
    pb[k] = pb[k - 1] * b;
    pc[k] = pc[k - 1] * c;
  }
  double pa = 1.0;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n - i; ++j) {
      const double powers = pb[static_cast<std::size_t>(j)] * pc[static_cast<std::size_t>(n - i - j)];
      visit(i, j, trinomial(n, i, j) * pa * powers);
    }
    pa *= a;
  }
}

SumOfTerms evaluate(const TrianglePolynomial<dvec3>& p, double a, double b, double c) {
  SumOfTerms sum;
  visit_basis(p.n, a, b, c, [&](int i, int j, double basis) { sum.add(basis, p.at(i, j)); });
  return sum;
}

SumOfTerms evaluate(const TrianglePolynomial<dvec3>& p, double u, double v) {
  return evaluate(p, u, v, std::max(1.0 - u - v, 0.0));
}

dvec3 value_inside(const TensorPolynomial<dvec3>& p, double u, double v) {
  double bu[max_binomial_degree + 1], bv[max_binomial_degree + 1];
  values_inside(p.m, u, bu);
  values_inside(p.n, v, bv);
  return sum_of(p, bu, bv).value;
}

dvec3 value_inside(const TrianglePolynomial<dvec3>& p, double u, double v) {
  return evaluate(p, std::max(u, inset), std::max(v, inset), std::max(1.0 - u - v, inset)).value;
}

// The value where its terms do not cancel: where it is good to 1e-13 or so. On the boundary only those terms
// remain that vanish nowhere along it; where none do, the limit from inside. Zero where terms cancel.
template <class Polynomial>
dvec3 value_or_limit(const Polynomial& p, double u, double v) {
  constexpr double cancelled = 1e-2;
  const SumOfTerms sum = evaluate(p, u, v);
  if (largest_component(sum.value) > cancelled * sum.terms) return sum.value;
  return sum.terms == 0.0 ? value_inside(p, u, v) : dvec3(0.0);
}

#ifdef __SIZEOF_FLOAT128__
using Quadruple = __float128;
#else
using Quadruple = long double;
#endif

// The cross product of the tangents in some 33 digits, as a vector of size 1 or so; zero where they are noise
// too.
dvec3 crossed_exactly(const Net& net, double u, double v) {
  const TangentsIn<Quadruple> t = tangents_in<Quadruple>(net, u, v);
  const Vector3In<Quadruple> n = cross_in(t.du, t.dv);
  const auto largest = [](const Vector3In<Quadruple>& a) {
    Quadruple m = 0;
    for (const Quadruple& x : a) m = std::max(m, x < 0 ? -x : x);
    return m;
  };
  const Quadruple size = largest(n), noise = largest(t.du) * largest(t.dv) * static_cast<Quadruple>(1e-17);
  if (!(size > noise)) return dvec3(0.0);
  return {static_cast<double>(n[0] / size), static_cast<double>(n[1] / size),
          static_cast<double>(n[2] / size)};
}

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

// Bounds on the sums of the sizes of what the point and the tangents are sums of, at one place.
struct Terms {
  double value = 0.0, du = 0.0, dv = 0.0;
};

// Of a coordinate w (x - p): what rounding of it is relative to.
double size_about(const dvec4& c, double reach) {
  return std::abs(c.x) + std::abs(c.y) + std::abs(c.z) + std::abs(c.w) * reach;
}

Terms terms_of(const TensorNet& net, double u, double v, double reach) {
  double bu[max_binomial_degree + 1], bv[max_binomial_degree + 1];
  double cu[max_binomial_degree + 1] = {}, cv[max_binomial_degree + 1] = {};
  bernstein_values(net.m, u, bu);
  bernstein_values(net.n, v, bv);
  if (net.m > 0) bernstein_values(net.m - 1, u, cu);
  if (net.n > 0) bernstein_values(net.n - 1, v, cv);
  Terms sum;
  for (int i = 0; i <= net.m; ++i) {
    const double du = net.m * ((i > 0 ? cu[i - 1] : 0.0) + (i < net.m ? cu[i] : 0.0));
    for (int j = 0; j <= net.n; ++j) {
      const double dv = net.n * ((j > 0 ? cv[j - 1] : 0.0) + (j < net.n ? cv[j] : 0.0));
      const double size = size_about(net.at(i, j), reach);
      sum.value += bu[i] * bv[j] * size;
      sum.du += du * bv[j] * size;
      sum.dv += bu[i] * dv * size;
    }
  }
  return sum;
}

Terms terms_of(const TriangleNet& net, double u, double v, double reach) {
  const double w = std::max(1.0 - u - v, 0.0);
  const auto size = [&](int i, int j) { return size_about(net.at(i, j), reach); };
  Terms sum;
  visit_basis(net.n, u, v, w, [&](int i, int j, double basis) { sum.value += basis * size(i, j); });
  if (net.n == 0) return sum;
  visit_basis(net.n - 1, u, v, w, [&](int i, int j, double basis) {
    sum.du += net.n * basis * (size(i + 1, j) + size(i, j));
    sum.dv += net.n * basis * (size(i, j + 1) + size(i, j));
  });
  return sum;
}

int degree_of(const Net& net) {
  if (const auto* t = std::get_if<TensorNet>(&net)) return std::max(t->m, t->n);
  return std::get<TriangleNet>(net).n;
}

// The estimates of a cross product's error are that up to a small factor: with these no normal beside a
// singular point of the studies' subjects is more than 3e-13 off, and a regular hit takes no longer than with
// larger ones.
constexpr double singular = 2e-2;
constexpr double accurate = 2e-13;  // of the relative error of a cross product

// The cross product of the tangents in units of the net's spread, in which it neither overflows nor
// underflows. Zero for a net that is one point.
dvec3 relative_cross(const Tangents& t, double scale) {
  return scale > 0.0 ? glm::cross(t.a / scale, t.b / scale) : dvec3(0.0);
}

// A bound, up to a small factor, on the relative error of the cross product of the tangents at (u, v);
// infinite where it vanishes.
double cross_error(const Net& net, double u, double v, const FirstOrder<dvec4>& f, const Tangents& t) {
  const double reach = std::abs(t.point.x) + std::abs(t.point.y) + std::abs(t.point.z);
  const Terms terms = std::visit([&](const auto& n) { return terms_of(n, u, v, reach); }, net);
  const double of_point = terms.value / std::abs(f.value.w);  // relative to epsilon, as all here
  const double of_a = terms.du + std::abs(f.du.w) * of_point, of_b = terms.dv + std::abs(f.dv.w) * of_point;
  const double a = largest_component(t.a), b = largest_component(t.b);
  if (!(a > 0.0 && b > 0.0)) return infinity;
  const double sine = glm::length(glm::cross(t.a / a, t.b / b));
  if (!(sine > 0.0)) return infinity;
  const double error = epsilon * degree_of(net) * (of_a / a + of_b / b) / sine;
  return std::isfinite(error) ? error : infinity;
}

}  // namespace

dvec3 unit_normal(const Net& net, double u, double v, const FirstOrder<dvec4>& f) {
  const Tangents t = tangents(f);
  const dvec3 n = glm::cross(t.a, t.b);
  const double size = glm::length(n);
  const double noise = normal_noise(degree_of(net), magnitude(net, f));
  if (is_regular_normal(noise, glm::length(t.a) + glm::length(t.b), size)) return n / size;
  const double scale = spread(net, t.point);
  if (scale == 0.0) return dvec3(0.0);
  const dvec3 relative = relative_cross(t, scale);
  if (glm::length(relative) > singular) return glm::normalize(relative);
  const double error = cross_error(net, u, v, f, t);
  const dvec3 crossed =
      error < infinity
          ? glm::normalize(glm::cross(t.a / largest_component(t.a), t.b / largest_component(t.b)))
          : dvec3(0.0);
  if (error <= accurate) return crossed;
  // Beside a singular point the polynomial's terms do not cancel. With very unequal weights its coefficients
  // may be noise all the same; then it contradicts the cross product.
  const NormalPolynomial polynomial = normal_directions(net);
  const dvec3 value =
      unit_or_zero(std::visit([&](const auto& p) { return value_or_limit(p, u, v); }, polynomial));
  const dvec3 limit = f.value.w < 0.0 ? -value : value;
  if (limit == dvec3(0.0) || glm::distance(limit, crossed) > 8.0 * error) {
    // Inside the domain, where only more digits help. At the singular point itself these end, too.
    const dvec3 exact = unit_or_zero(crossed_exactly(net, u, v));
    if (exact != dvec3(0.0)) return exact;
    const dvec3 last =
        unit_or_zero(std::visit([&](const auto& p) { return value_inside(p, u, v); }, polynomial));
    return f.value.w < 0.0 ? -last : last;
  }
  return limit;
}

dvec3 unit_normal(const Net& net, double u, double v) { return unit_normal(net, u, v, net_first(net, u, v)); }

Curvature curvature(const Net& net, double u, double v) {
  const FirstOrder<dvec4> first = net_first(net, u, v);
  const Tangents t = tangents(first);
  const double scale = spread(net, t.point);
  const double size = glm::length(relative_cross(t, scale));
  // Below `vanishing` the square by which all is divided may be zero, in scenes of the smallest size.
  constexpr double near_singular = 1e-4, known = 1e-11, vanishing = 1e-30;
  if (!(size > vanishing) || (!(size > near_singular) && !(cross_error(net, u, v, first, t) <= known))) {
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
  return {quotient(l * k - m * m, area), quotient(e * k - 2.0 * f * m + g * l, 2.0 * area)};
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
