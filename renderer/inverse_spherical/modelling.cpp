#include "renderer/inverse_spherical/modelling.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/bezier/elevate.h"
#include "renderer/bezier/triangle.h"
#include "renderer/inverse_spherical/spherical_triangle.h"

namespace rondure {
namespace {

template <class T>
std::vector<T> elevate(std::vector<T> net, int n, int times) {
  for (int k = 0; k < times; ++k) {
    std::vector<T> next(static_cast<std::size_t>(triangle_size(n + k + 1)));
    triangle_elevate(net.data(), n + k, next.data());
    net = std::move(next);
  }
  return net;
}

dvec3 on_domain(const PlanarIss& s, dvec2 at) {
  return at.x * s.corners[0] + at.y * s.corners[1] + (1.0 - at.x - at.y) * s.corners[2];
}

}  // namespace

PlanarIss elevated(const PlanarIss& s, int times) {
  return {s.n + times, s.corners, elevate(s.weights, s.n, times)};
}

TriangleNet elevated(const TriangleNet& net, int times) {
  TriangleNet out;
  out.n = net.n + times;
  out.points = elevate(net.points, net.n, times);
  return out;
}

PlanarIss restricted(const PlanarIss& s, const std::array<dvec2, 3>& corners) {
  PlanarIss out{s.n, {}, std::vector<double>(s.weights.size())};
  for (std::size_t m = 0; m < 3; ++m) out.corners[m] = on_domain(s, corners[m]);
  triangle_restrict(s.weights.data(), s.n, corners.data(), out.weights.data());
  return out;
}

std::array<PlanarIss, 3> split_at(const PlanarIss& s, double u, double v) {
  const dvec2 p(u, v), a(1, 0), b(0, 1), c(0, 0);
  return {restricted(s, {p, b, c}), restricted(s, {a, p, c}), restricted(s, {a, b, p})};
}

std::array<PlanarIss, 4> quartered(const PlanarIss& s) {
  const dvec2 a(1, 0), b(0, 1), c(0, 0), ab(0.5, 0.5), bc(0, 0.5), ac(0.5, 0);
  return {restricted(s, {a, ab, ac}), restricted(s, {ab, b, bc}), restricted(s, {ac, bc, c}),
          restricted(s, {bc, ac, ab})};
}

dvec3 InverseCircularCurve::point(double t) const {
  std::vector<double> work = weights;
  for (int left = n; left > 0; --left) detail::casteljau_step(work.data(), left, t);
  return ((1.0 - t) * from + t * to) / work[0];
}

std::vector<double> InverseCircularCurve::coefficients() const {
  std::vector<double> c;
  for (int k = 0; k <= n; ++k) {
    const double t = static_cast<double>(k) / n;
    c.push_back(weights[c.size()] / glm::length((1.0 - t) * from + t * to));
  }
  return c;
}

std::vector<dvec4> InverseCircularCurve::control_points() const {
  std::vector<dvec4> points;
  for (int k = 0; k <= n; ++k) {
    const double t = static_cast<double>(k) / n;
    points.emplace_back((1.0 - t) * from + t * to, weights[points.size()]);
  }
  return points;
}

InverseCircularCurve along_arc(const PlanarIss& s, dvec2 from, dvec2 to) {
  // The side from the first corner to the second of a part whose third corner does not matter.
  const PlanarIss part = restricted(s, {from, to, from});
  InverseCircularCurve curve{s.n, part.corners[0], part.corners[1], {}};
  for (int k = 0; k <= s.n; ++k) {
    curve.weights.push_back(part.weights[static_cast<std::size_t>(triangle_index(s.n, s.n - k, k))]);
  }
  return curve;
}

std::optional<InverseCircularCurve> along_arc(const PlanarIss& s, const dvec3& from, const dvec3& to) {
  // Over the chord between the unit directions, the coordinates in the corners are linear. Within the
  // rounding of their determinants a coordinate is 0.
  const dvec3 ends[2] = {glm::normalize(from), glm::normalize(to)};
  const auto& c = s.corners;
  const double det = orientation(c[0], c[1], c[2]);
  dvec3 b[2];
  for (int e = 0; e < 2; ++e) {
    for (int i = 0; i < 3; ++i) {
      const dvec3 &second = c[static_cast<std::size_t>((i + 1) % 3)],
                  &third = c[static_cast<std::size_t>((i + 2) % 3)];
      b[e][i] = orientation(ends[e], second, third) / det;
      const double rounding = 8.0 * 0x1p-52 * glm::length(second) * glm::length(third) / std::abs(det);
      if (std::abs(b[e][i]) <= rounding) b[e][i] = 0.0;
    }
  }
  double enter = 0.0, leave = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double low = b[0][i], high = b[1][i];
    if (low < 0.0 && high < 0.0) return std::nullopt;
    if (low < 0.0) enter = std::max(enter, low / (low - high));
    if (high < 0.0) leave = std::min(leave, low / (low - high));
  }
  // What is shorter than this is a point, seen through rounding.
  if (!(leave - enter > 0x1p-40)) return std::nullopt;
  dvec2 at[2];
  for (int e = 0; e < 2; ++e) {
    const double t = e == 0 ? enter : leave;
    const dvec3 here = glm::max((1.0 - t) * b[0] + t * b[1], dvec3(0.0));
    at[e] = dvec2(here) / (here.x + here.y + here.z);
  }
  return along_arc(s, at[0], at[1]);
}

}  // namespace rondure
