#include "renderer/normals/implicit_quadric.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/rational.h"
#include "renderer/projective/null_vector.h"

namespace rondure {
namespace {

// Points of the patches, in a fixed order that scatters over all of them.
std::vector<dvec3> sampled(const std::vector<Net>& patches, std::size_t count) {
  std::vector<dvec3> points;
  // Roberts's sequence (2018): any run of it is spread evenly over the square.
  constexpr double step_u = 0.7548776662466927, step_v = 0.5698402909980532;
  for (std::size_t k = 0; k < count; ++k) {
    const Net& net = patches[k % patches.size()];
    const auto n = static_cast<double>(k + 1);
    double u = std::fmod(0.5 + n * step_u, 1.0), v = std::fmod(0.5 + n * step_v, 1.0);
    if (std::holds_alternative<TriangleNet>(net) && u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    points.push_back(net_point(net, u, v));
  }
  return points;
}

using Rows = std::vector<std::vector<Complex>>;

// The unit vector that every row annihilates, if there is just one.
std::optional<std::vector<double>> only_null_vector(const std::vector<std::vector<double>>& rows) {
  Rows complex;
  for (const auto& row : rows) complex.emplace_back(row.begin(), row.end());
  const NullVector found = null_vector(std::move(complex));
  if (found.nullity != 1) return {};
  // Real up to a phase: turned so that the largest entry is real.
  Complex largest = found.vector[0];
  for (const Complex& x : found.vector)
    if (std::abs(x) > std::abs(largest)) largest = x;
  std::vector<double> real;
  for (const Complex& x : found.vector)
    real.push_back(static_cast<double>((x * std::conj(largest)).real() / std::abs(largest)));
  return real;
}

// The quadric, if all of the points lie on it.
std::optional<ImplicitQuadric> confirmed(const ImplicitQuadric& q, const std::vector<dvec3>& points) {
  const double extent = q.scale + glm::length(q.centre);
  for (const dvec3& p : points)
    if (!(std::abs(q.distance(p)) <= 64.0 * epsilon * extent)) return {};
  return q;
}

}  // namespace

double ImplicitQuadric::value(const dvec3& x) const {
  const dvec3 y = (x - centre) / scale;
  return glm::dot(y, a * y) + 2.0 * glm::dot(b, y) + c;
}

dvec3 ImplicitQuadric::gradient(const dvec3& x) const {
  return 2.0 * (a * ((x - centre) / scale) + b) / scale;
}

double ImplicitQuadric::distance(const dvec3& x) const {
  const double slope = glm::length(gradient(x));
  return slope > 0.0 ? std::abs(value(x)) / slope : -1.0;
}

QuadricCurvature quadric_curvature(const ImplicitQuadric& q, const dvec3& x, double direction) {
  const dvec3 g = q.gradient(x);
  const dmat3 h = q.a * (2.0 / (q.scale * q.scale));
  const double length2 = glm::dot(g, g), length = std::sqrt(length2);
  // Goldman (2005): K = g . adj(H) g / |g|^4, and twice the mean curvature (g . H g - |g|^2 tr H) / |g|^3.
  const dmat3 adjugate(glm::cross(h[1], h[2]), glm::cross(h[2], h[0]), glm::cross(h[0], h[1]));
  const double trace = h[0][0] + h[1][1] + h[2][2];
  return {glm::dot(g, adjugate * g) / (length2 * length2),
          direction * (glm::dot(g, h * g) - length2 * trace) / (2.0 * length2 * length)};
}

std::optional<ImplicitQuadric> quadric_through(const std::vector<Net>& patches) {
  if (patches.empty()) return {};
  const std::size_t fitted = 24, checked = std::max<std::size_t>(96, 8 * patches.size());
  const std::vector<dvec3> points = sampled(patches, checked);
  dvec3 low = points[0], high = points[0];
  for (const dvec3& p : points) low = glm::min(low, p), high = glm::max(high, p);
  ImplicitQuadric q;
  const dvec3 half = 0.5 * (high - low);
  q.scale = std::max({half.x, half.y, half.z});
  if (!(q.scale > 0.0) || !std::isfinite(q.scale)) return {};
  // About the origin if it is near, so that symmetric surfaces stay symmetric.
  q.centre = 0.5 * (low + high);
  if (glm::length(q.centre) < 8.0 * q.scale) q.centre = dvec3(0.0);
  const auto local = [&](const dvec3& p) { return (p - q.centre) / q.scale; };
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; k < fitted; ++k) {
    const dvec3 y = local(points[k]);
    rows.push_back({y.x, y.y, y.z, 1.0});
  }
  if (const auto plane = only_null_vector(rows)) {
    q.b = 0.5 * dvec3((*plane)[0], (*plane)[1], (*plane)[2]);
    q.c = (*plane)[3];
    return confirmed(q, points);
  }
  // Five unknowns are told from a small piece of a sphere where ten are not.
  for (std::size_t k = 0; k < fitted; ++k) {
    const dvec3 y = local(points[k]);
    rows[k] = {glm::dot(y, y), 2 * y.x, 2 * y.y, 2 * y.z, 1.0};
  }
  if (const auto sphere = only_null_vector(rows)) {
    q.a = dmat3((*sphere)[0]);
    q.b = dvec3((*sphere)[1], (*sphere)[2], (*sphere)[3]);
    q.c = (*sphere)[4];
    return confirmed(q, points);
  }
  for (std::size_t k = 0; k < fitted; ++k) {
    const dvec3 y = local(points[k]);
    rows[k] = {y.x * y.x,     y.y * y.y, y.z * y.z, 2 * y.x * y.y, 2 * y.y * y.z,
               2 * y.z * y.x, 2 * y.x,   2 * y.y,   2 * y.z,       1.0};
  }
  const auto found = only_null_vector(rows);
  if (!found) return {};
  const std::vector<double>& f = *found;
  q.a = dmat3(f[0], f[3], f[5], f[3], f[1], f[4], f[5], f[4], f[2]);
  q.b = dvec3(f[6], f[7], f[8]);
  q.c = f[9];
  return confirmed(q, points);
}

}  // namespace rondure
