#include "renderer/projective/spherical_quad.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/bezier/quotient.h"
#include "renderer/projective/frame.h"

namespace rondure {
namespace {

constexpr long double degrees = 180 / std::numbers::pi_v<long double>;
// Corners are doubles, or sums of roots: angles closer than this to a limit are taken to be at it.
constexpr long double tolerance = 1e-6L;

constexpr long double least_corner_weight = 1e-9L;

std::string number(long double angle) { return fmt::format("{:.9g}", static_cast<double>(angle)); }

using Part = QuadDefect::Part;

std::optional<QuadDefect> corner_defect(const QuadShape& shape, bool straight_corners) {
  const auto reflex = std::count_if(shape.angle.begin(), shape.angle.end(),
                                    [](long double a) { return a > 180 + tolerance; });
  for (std::size_t k = 0; k < 4; ++k) {
    const long double angle = shape.angle[k];
    const auto defect = [&](const std::string& rest) {
      return QuadDefect{
          Part::corner, k,
          fmt::format("corners[{}] has an interior angle of {} degrees{}", k, number(angle), rest)};
    };
    if (angle > 360 - tolerance || angle < tolerance)
      return QuadDefect{Part::corner, k,
                        fmt::format("corners[{}] has an interior angle of 0 degrees: its arcs touch", k)};
    if (angle > 180 + tolerance)
      return defect(std::string("; with more than 180 no image in a plane is convex") +
                    (reflex > 2 ? " (corners are listed counter-clockwise, seen from outside)" : ""));
    if (angle > 180 - tolerance && !straight_corners)
      return defect(", where the patch would be singular; it must be less than 180");
  }
  return std::nullopt;
}

std::optional<QuadDefect> arc_defect(const QuadShape& shape) {
  for (std::size_t k = 0; k < 4; ++k) {
    const long double bend = shape.bend[k];
    const std::string name = fmt::format("arcs[{}], from corners[{}] to corners[{}],", k, k, (k + 1) % 4);
    if (bend < -tolerance)
      return QuadDefect{
          Part::arc, k,
          fmt::format("{} bends inward by {} degrees in the plane, so that the image is not convex", name,
                      number(-bend))};
    if (bend > 180 - tolerance)
      return QuadDefect{
          Part::arc, k,
          fmt::format("{} turns by {} degrees in the plane; it must be less than 180", name, number(bend))};
  }
  return std::nullopt;
}

}  // namespace

SphericalQuad geodesic_quad(const std::array<lvec3, 4>& c) {
  return {{great_arc(c[0], c[1]), great_arc(c[1], c[2]), great_arc(c[2], c[3]), great_arc(c[3], c[0])}};
}

QuadShape shape_of(const SphericalQuad& quad, const lvec3& centre) {
  const StereographicFrame frame(centre);
  QuadShape shape{};
  for (std::size_t k = 0; k < 4; ++k) {
    const SphereArc& arc = quad.arc[k];
    const lvec3 ahead = arc.start_tangent(), back = -quad.arc[(k + 3) % 4].end_tangent();
    const long double angle =
        std::atan2(glm::dot(arc.p, glm::cross(ahead, back)), glm::dot(ahead, back)) * degrees;
    shape.angle[k] = angle < 0 ? angle + 360 : angle;

    const lvec3 p = frame.project(arc.p, 1), q = frame.project(arc.q, 1), b = frame.project(arc.b, arc.w);
    shape.weight[k] = p.z;
    if (p.z == 0 || q.z == 0) continue;
    // With the corners' weights brought to 1, the middle one is the cosine of half the turn, and the
    // determinant its sine times half the square of the chord.
    const long double root = std::sqrt(p.z * q.z);
    const lvec3 chord = q / q.z - p / p.z;
    const long double sine =
        quotient(2 * glm::dot(p, glm::cross(b, q)), p.z * q.z * root * glm::dot(chord, chord));
    shape.bend[k] = 2 * std::atan2(sine, b.z / root) * degrees;
  }
  return shape;
}

std::optional<QuadDefect> defect_of(const QuadShape& shape, bool straight_corners) {
  if (auto defect = corner_defect(shape, straight_corners)) return defect;
  for (std::size_t k = 0; k < 4; ++k) {
    if (!(shape.weight[k] > least_corner_weight))
      return QuadDefect{Part::corner, k,
                        fmt::format("corners[{}] lies where one projects from, opposite the centre", k)};
  }
  if (auto defect = arc_defect(shape)) return defect;
  long double turn = 0;
  for (std::size_t k = 0; k < 4; ++k) turn += 180 - shape.angle[k] + shape.bend[k];
  if (std::abs(turn - 360) > 1) {
    return QuadDefect{
        Part::whole, 0,
        fmt::format("in the plane the arcs turn by {} degrees in all, not by 360: they cross", number(turn))};
  }
  return std::nullopt;
}

}  // namespace rondure
