#include "renderer/continuity/normal_zero.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace rondure {
namespace {

TensorPolynomial<dvec3> derivative(const TensorPolynomial<dvec3>& p, bool in_u) {
  const int m = in_u ? p.m - 1 : p.m, n = in_u ? p.n : p.n - 1;
  if (m < 0 || n < 0) return {};
  TensorPolynomial<dvec3> d(m, n);
  const double degree = in_u ? p.m : p.n;
  for (int i = 0; i <= m; ++i)
    for (int j = 0; j <= n; ++j)
      d.at(i, j) = degree * (p.at(i + (in_u ? 1 : 0), j + (in_u ? 0 : 1)) - p.at(i, j));
  return d;
}

TrianglePolynomial<dvec3> derivative(const TrianglePolynomial<dvec3>& p, bool in_u) {
  if (p.n < 1) return {};
  TrianglePolynomial<dvec3> d(p.n - 1);
  for (int i = 0; i < p.n; ++i)
    for (int j = 0; j < p.n - i; ++j)
      d.at(i, j) = static_cast<double>(p.n) * (p.at(i + (in_u ? 1 : 0), j + (in_u ? 0 : 1)) - p.at(i, j));
  return d;
}

NormalPolynomial derivative(const NormalPolynomial& p, bool in_u) {
  return std::visit([&](const auto& q) { return NormalPolynomial(derivative(q, in_u)); }, p);
}

double largest_of(const NormalPolynomial& p) {
  double largest = 0.0;
  std::visit(
      [&](const auto& q) {
        for (const dvec3& c : q.coefficients) largest = std::max(largest, glm::length(c));
      },
      p);
  return largest;
}

// The distance from the boundary, negative outside.
double inside_by(const NormalPolynomial& p, dvec2 at) {
  if (std::holds_alternative<TensorPolynomial<dvec3>>(p))
    return std::min({at.x, at.y, 1.0 - at.x, 1.0 - at.y});
  return std::min({at.x, at.y, (1.0 - at.x - at.y) * std::sqrt(0.5)});
}

// Of the matrix with columns a and b, and its determinant.
struct Inverse {
  dvec2 first, second;  // rows
  double size = std::numeric_limits<double>::infinity();
};

Inverse inverse_of(const dvec2& a, const dvec2& b) {
  const double det = a.x * b.y - b.x * a.y;
  Inverse m{dvec2(b.y, -b.x) / det, dvec2(-a.y, a.x) / det};
  m.size = std::sqrt(glm::dot(m.first, m.first) + glm::dot(m.second, m.second));
  return m;
}

}  // namespace

ZeroFinder::ZeroFinder(NormalPolynomial normal, double noise)
    : normal_(std::move(normal)),
      du_(derivative(normal_, true)),
      dv_(derivative(normal_, false)),
      noise_(noise),
      size_(largest_of(normal_)) {
  const double uu = largest_of(derivative(du_, true)), uv = largest_of(derivative(du_, false)),
               vv = largest_of(derivative(dv_, false));
  second_ = 1.001 * std::sqrt(uu * uu + 2.0 * uv * uv + vv * vv);
}

std::optional<dvec2> ZeroFinder::from(dvec2 at) const {
  // What rounding leaves of a zero: some tens of epsilon, and those of where it lies.
  const double zero = 1e-13 * size_;
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 40; ++step) {
    const dvec3 f = polynomial_value(normal_, at.x, at.y);
    // From its zero on, for as long as steps grow shorter.
    if (!(glm::length(f) > 0.0)) break;
    const dvec3 fu = polynomial_value(du_, at.x, at.y), fv = polynomial_value(dv_, at.x, at.y);
    // Along a singular curve N changes across it only, and near a double zero little in one direction:
    // Levenberg's term keeps steps along it short.
    const double both = glm::dot(fu, fu) + glm::dot(fv, fv), damping = 1e-13 * both;
    if (!(both > 0.0)) break;
    const double a = glm::dot(fu, fu) + damping, b = glm::dot(fu, fv), c = glm::dot(fv, fv) + damping;
    const dvec2 right(glm::dot(fu, f), glm::dot(fv, f));
    const dvec2 move = dvec2(c * right.x - b * right.y, a * right.y - b * right.x) / (a * c - b * b);
    const double length = glm::length(move);
    if (glm::length(f) <= zero && !(length < 0.5 * last)) break;
    last = length;
    at -= move;
    if (!(length > 1e-17) || !(glm::length(at) < 4.0)) break;
  }
  const double slack = 1e-9;
  if (!(inside_by(normal_, at) >= -slack)) return {};
  at = glm::clamp(at, 0.0, 1.0);
  const bool triangle = std::holds_alternative<TrianglePolynomial<dvec3>>(normal_);
  if (triangle && at.x + at.y > 1.0) at /= at.x + at.y;
  if (!(glm::length(polynomial_value(normal_, at.x, at.y)) <= zero)) return {};
  return at;
}

std::optional<ZeroFinder::Proof> ZeroFinder::proof(dvec2 at) const {
  const dvec3 f = polynomial_value(normal_, at.x, at.y), fu = polynomial_value(du_, at.x, at.y),
              fv = polynomial_value(dv_, at.x, at.y);
  // The minors are the coordinates of the tangent that is left, up to a factor: that of the coordinate left
  // out is not zero.
  const dvec3 minors = glm::cross(fu, fv), sizes = glm::abs(minors);
  const int out = sizes.x > sizes.y ? (sizes.x > sizes.z ? 0 : 2) : (sizes.y > sizes.z ? 1 : 2);
  if (!(sizes[out] > 1e-9 * glm::length(fu) * glm::length(fv))) return {};
  const int i = (out + 1) % 3, j = (out + 2) % 3;
  const Inverse inverse = inverse_of({fu[i], fu[j]}, {fv[i], fv[j]});
  // Noise of the coefficients is one of the values, and times twice the degree one of the derivatives.
  const auto* tensor = std::get_if<TensorPolynomial<dvec3>>(&normal_);
  const double degree =
      tensor ? std::max(tensor->m, tensor->n) : std::get<TrianglePolynomial<dvec3>>(normal_).n;
  const double wrong = inverse.size * 4.0 * degree * noise_ + 1e-6;  // of the inverse, relative
  const double off = inverse.size * (glm::length(dvec2(f[i], f[j])) + 2.0 * noise_);
  if (!std::isfinite(off) || !(wrong < 0.25)) return {};
  Proof proof;
  // The Newton map shrinks distances to a half or less within `alone`.
  proof.alone = second_ > 0.0 ? std::min(2.0, (0.5 - wrong) / (inverse.size * second_)) : 2.0;
  proof.within = 2.0 * off;
  if (!(proof.within < proof.alone)) return {};
  proof.inside = inside_by(normal_, at) > proof.within;
  return proof;
}

}  // namespace rondure
