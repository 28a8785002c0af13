#include "renderer/inverse_spherical/join.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "renderer/bezier/index.h"
#include "renderer/bezier/triangle_keys.h"
#include "renderer/inverse_spherical/spherical_triangle.h"

namespace rondure {
namespace {

// A vertex counts as coplanar when alpha + beta + gamma is 1 to rounding of the combination.
constexpr double coplanar = 0x1p-44;

}  // namespace

dvec3 domain_combination(const PlanarIss& s, const dvec3& vertex) {
  return spherical_barycentric(s.corners, vertex);  // linear in v, whatever the moduli of the corners
}

std::optional<dvec3> coplanar_vertex(const PlanarIss& s, const dvec3& direction) {
  const dvec3 k = domain_combination(s, direction);
  const double sum = k.x + k.y + k.z;
  if (!(sum > 0.0)) return std::nullopt;
  return direction / sum;
}

std::optional<std::vector<double>> reduced_side(const PlanarIss& s) {
  const int n = s.n;
  const auto side = [&](int j) { return s.weights[index(triangle_index(n, 0, j))]; };
  // From both ends to the middle, where the two runs must agree: w_j = (j w'_{j-1} + (n - j) w'_j) / n.
  std::vector<double> reduced(static_cast<std::size_t>(n), 0.0);
  const int half = (n - 1) / 2;
  double largest = 0.0;
  for (int j = 0; j <= n; ++j) largest = std::max(largest, std::abs(side(j)));
  for (int j = 0; j <= half; ++j) {
    const double before = j > 0 ? reduced[static_cast<std::size_t>(j - 1)] : 0.0;
    reduced[static_cast<std::size_t>(j)] = (n * side(j) - j * before) / (n - j);
  }
  for (int j = n - 1; j > half; --j) {
    const double after = j < n - 1 ? reduced[static_cast<std::size_t>(j + 1)] : 0.0;
    reduced[static_cast<std::size_t>(j)] = (n * side(j + 1) - (n - 1 - j) * after) / (j + 1);
  }
  const double left = half >= 0 ? reduced[static_cast<std::size_t>(half)] : 0.0;
  const double right = half + 1 < n ? reduced[static_cast<std::size_t>(half + 1)] : 0.0;
  const double met = ((half + 1) * left + (n - half - 1) * right) / n;
  if (std::abs(met - side(half + 1)) > 1e-12 * largest) return std::nullopt;
  return reduced;
}

PlanarIss joined(const PlanarIss& s, const dvec3& vertex, const std::vector<double>& weights) {
  const int n = s.n;
  const dvec3 k = domain_combination(s, vertex);
  const double excess = k.x + k.y + k.z - 1.0;
  if (!(k.x < 0.0)) {
    throw std::invalid_argument(
        fmt::format("the new vertex must lie beyond the common side, on the far side from the first patch's "
                    "corner (alpha = {:.6g} is not negative)",
                    k.x));
  }
  std::optional<std::vector<double>> lower;
  if (std::abs(excess) > coplanar * (std::abs(k.x) + std::abs(k.y) + std::abs(k.z) + 1.0)) {
    lower = reduced_side(s);
    if (!lower) {
      throw std::invalid_argument(
          fmt::format("the new vertex is not in the plane of the first patch's domain (alpha + beta + gamma "
                      "= {:.10g}, not 1), "
                      "and the common side is not of degree {}, as a join across planes needs",
                      excess + 1.0, n - 1));
    }
  }
  PlanarIss out{n, {vertex, s.corners[1], s.corners[2]}, weights};
  for (int j = 0; j <= n; ++j)
    out.weights[index(triangle_index(n, 0, j))] = s.weights[index(triangle_index(n, 0, j))];
  for (int j = 0; j < n; ++j) {
    double w = k.x * s.weights[index(triangle_index(n, 1, j))] +
               k.y * s.weights[index(triangle_index(n, 0, j + 1))] +
               k.z * s.weights[index(triangle_index(n, 0, j))];
    if (lower) w -= (n - 1.0) / n * excess * (*lower)[static_cast<std::size_t>(j)];
    if (!(w > 0.0)) {
      throw std::invalid_argument(
          fmt::format("the join makes weight {} of the new patch {:.6g}, not positive; move the vertex "
                      "closer to the side",
                      triangle_key_name(n, 1, j), w));
    }
    out.weights[index(triangle_index(n, 1, j))] = w;
  }
  return out;
}

}  // namespace rondure
