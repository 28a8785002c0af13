#include "renderer/inverse_spherical/evaluate.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/bezier/triangle.h"
#include "renderer/inverse_spherical/spherical_triangle.h"

namespace rondure {
namespace {

template <class T>
T casteljau(std::vector<T> work, int n, double u, double v) {
  for (int left = n; left > 0; --left) detail::triangle_step(work.data(), left, dvec2(u, v));
  return work[0];
}

}  // namespace

dvec3 point_by_casteljau(const TriangleNet& net, double u, double v) {
  const dvec4 p = casteljau(net.points, net.n, u, v);
  return dvec3(p) / p.w;
}

SphericalPoint point_by_spherical_casteljau(const Iss& s, double u, double v) {
  std::vector<dvec3> a = s.u;
  std::vector<double> c = s.c;
  const dvec3 tau(u, v, 1.0 - u - v);
  for (int left = s.n; left > 0; --left) {
    std::size_t to = 0;
    for (int i = 0; i < left; ++i) {
      for (int j = 0; j < left - i; ++j, ++to) {
        const auto first = static_cast<std::size_t>(triangle_index(left, i + 1, j));
        const auto second = static_cast<std::size_t>(triangle_index(left, i, j + 1));
        const auto third = static_cast<std::size_t>(triangle_index(left, i, j));
        const dvec3 next = tau.x * a[first] + tau.y * a[second] + tau.z * a[third];
        const double length = glm::length(next);
        const double next_c = tau.x * (glm::length(a[first]) / length) * c[first] +
                              tau.y * (glm::length(a[second]) / length) * c[second] +
                              tau.z * (glm::length(a[third]) / length) * c[third];
        a[to] = next;
        c[to] = next_c;
      }
    }
  }
  return {a[0] / glm::length(a[0]), c[0]};
}

dvec3 point_by_weights(const PlanarIss& s, double u, double v) {
  const double w = casteljau(s.weights, s.n, u, v);
  return (u * s.corners[0] + v * s.corners[1] + (1.0 - u - v) * s.corners[2]) / w;
}

dvec3 point_by_sums(const Iss& s, double u, double v) {
  const detail::TriangleBasis<dynamic> basis(s.n, u, v);
  dvec3 numerator(0.0);
  double denominator = 0.0;
  for (std::size_t k = 0; k < s.u.size(); ++k) {
    numerator += basis.b[k] * s.u[k];
    denominator += basis.b[k] * (s.c[k] * glm::length(s.u[k]));
  }
  return numerator / denominator;
}

std::optional<double> radius_towards(const PlanarIss& s, const dvec3& v) {
  const dvec3 tau = domain_coordinates(s.corners, v);
  if (tau == dvec3(0.0)) return std::nullopt;
  const dvec3 on_plane = tau.x * s.corners[0] + tau.y * s.corners[1] + tau.z * s.corners[2];
  if (!(glm::dot(on_plane, v) > 0.0)) return std::nullopt;
  // What rounding makes of a coordinate: some eps of the products in its determinant.
  const double det = std::abs(orientation(s.corners[0], s.corners[1], s.corners[2]));
  const double a = glm::length(s.corners[0]), b = glm::length(s.corners[1]), c = glm::length(s.corners[2]);
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * glm::length(on_plane) / det;
  const dvec3 slack = rounding * dvec3(b * c, c * a, a * b);
  if (!(tau.x >= -slack.x && tau.y >= -slack.y && tau.z >= -slack.z)) return std::nullopt;
  return glm::length(on_plane) / triangle_value(s.weights.data(), s.n, tau.x, tau.y);
}

}  // namespace rondure
