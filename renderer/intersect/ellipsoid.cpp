#include "renderer/intersect/ellipsoid.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "renderer/bezier/quotient.h"

namespace rondure {
namespace {

double frobenius(const dmat3& m) {
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

double largest_of(const dmat3& m) {
  double out = 0.0;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) out = std::fmax(out, std::fabs(m[j][i]));
  return out;
}

// Brought to size one by a power of two, which changes no bit, as the determinant of a small matrix is no
// double.
dmat3 inverse_of(const dmat3& map) {
  const double scale = std::ldexp(1.0, -std::ilogb(largest_of(map)));
  return glm::inverse(map * scale) * scale;
}

}  // namespace

bool is_too_flat(const dmat3& map) {
  const double size = largest_of(map);
  if (!(size > 0.0) || !std::isfinite(size)) return true;
  const dmat3 unit = map / size;
  if (glm::determinant(unit) == 0.0) return true;
  // At least the ratio of the semi-axes, and at most three times it.
  return !(frobenius(unit) * frobenius(glm::inverse(unit)) <= flattest_ellipsoid);
}

Ellipsoid::Ellipsoid(const dmat3& map) : linear(map), inverse(inverse_of(map)) {
  // Semi-axes lie between the column lengths' extremes only for orthogonal columns: the Frobenius norm bounds
  // them all.
  extent = frobenius(map);
  const double r = glm::length(map[0]);
  const double skew = std::fmax(
      std::fmax(std::fabs(glm::length(map[1]) - r), std::fabs(glm::length(map[2]) - r)),
      quotient(std::fmax(std::fmax(std::fabs(glm::dot(map[0], map[1])), std::fabs(glm::dot(map[1], map[2]))),
                         std::fabs(glm::dot(map[2], map[0]))),
               r));
  if (skew <= 8.0 * unit_roundoff * r) uniform_radius = extent = r;
}

Ellipsoid on_principal_axes(const dmat3& map) {
  Ellipsoid out(map);
  if (out.uniform_radius > 0.0) return out;
  using Wide = glm::mat<3, 3, long double>;
  Wide columns(map), turn(1);
  // One-sided Jacobi (Hestenes 1958): turns pairs of columns until they are orthogonal, quadratically.
  bool orthogonal = false;
  for (int sweep = 0; sweep < 16 && !orthogonal; ++sweep) {
    orthogonal = true;
    for (int i = 0; i < 2; ++i)
      for (int j = i + 1; j < 3; ++j) {
        const long double aa = glm::dot(columns[i], columns[i]), bb = glm::dot(columns[j], columns[j]),
                          ab = glm::dot(columns[i], columns[j]);
        if (std::fabs(ab) <= 0x1p-62L * std::sqrt(aa * bb)) continue;
        orthogonal = false;
        const long double angle = 0.5L * std::atan2(2 * ab, aa - bb), c = std::cos(angle),
                          s = std::sin(angle);
        for (Wide* m : {&columns, &turn}) {
          const auto a = (*m)[i], b = (*m)[j];
          (*m)[i] = c * a + s * b, (*m)[j] = c * b - s * a;
        }
      }
  }
  Wide rows;
  for (int k = 0; k < 3; ++k) rows[k] = columns[k] / glm::dot(columns[k], columns[k]);
  out.linear = dmat3(columns), out.inverse = dmat3(glm::transpose(rows)), out.turn = dmat3(turn);
  return out;
}

dvec2 ellipsoid_parameters(const Ellipsoid& surface, const dvec3& point) noexcept {
  const dvec3 p = surface.turn * (surface.inverse * point);
  const double turn = std::atan2(p.y, p.x) / (2.0 * std::numbers::pi);
  return {turn < 0.0 ? turn + 1.0 : turn,
          std::atan2(std::sqrt(p.x * p.x + p.y * p.y), p.z) / std::numbers::pi};
}

std::optional<EllipsoidPassage> meet_ellipsoid(const Ellipsoid& surface, const LocalRay& ray) noexcept {
  const bool uniform = surface.uniform_radius > 0.0;
  const dvec3 origin = uniform ? ray.base / surface.uniform_radius : surface.inverse * ray.base;
  const dvec3 direction = uniform ? ray.direction / surface.uniform_radius : surface.inverse * ray.direction;
  const double length2 = glm::dot(direction, direction);
  // From the point nearest to the centre the quadratic has no linear term, and its discriminant no
  // cancellation.
  dvec3 nearest = origin - (glm::dot(origin, direction) / length2) * direction;
  // Where the unit sphere's space is stretched, rounding left it off the middle by as much.
  if (!uniform) nearest -= (glm::dot(nearest, direction) / length2) * direction;
  const double impact = glm::length(nearest);
  if (!(impact <= 1.0)) return std::nullopt;
  return EllipsoidPassage{nearest, std::sqrt((1.0 - impact) * (1.0 + impact) / length2) * direction};
}

EllipsoidHit ellipsoid_hit(const Ellipsoid& e, const EllipsoidPassage& chord, int side) noexcept {
  dvec3 on_sphere = side < 0 ? chord.middle - chord.half : chord.middle + chord.half;
  on_sphere /= glm::length(on_sphere);
  // Of a sphere the normal is exact in the surface's own axes: a rotation would only round it again.
  if (e.uniform_radius > 0.0) return {e.uniform_radius * on_sphere, on_sphere};
  return {e.linear * on_sphere,
          glm::normalize(on_sphere * e.inverse)};  // row vector times inverse: the inverse transpose
}

}  // namespace rondure
