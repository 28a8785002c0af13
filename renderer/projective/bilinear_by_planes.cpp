#include <cmath>

#include "renderer/projective/circular_patch.h"

namespace rondure {
namespace {

// Where the circles of two arcs that follow each other meet again.
lvec3 second_meeting(const SphereArc& in, const SphereArc& out) {
  const auto normal = [](const SphereArc& arc) { return glm::cross(arc.q - arc.p, arc.b - arc.w * arc.p); };
  const lvec3 line = glm::normalize(glm::cross(normal(in), normal(out)));
  return out.p - 2 * glm::dot(out.p, line) * line;
}

// q or -q, so that the segment from p goes to the arc and not to the rest of its circle.
lvec4 along(const SphereArc& arc, const lvec4& p, const lvec4& q) {
  const Spinor middle = spinor_at(glm::normalize(arc.p + arc.q + 2.0L * arc.b));
  return (det(middle, to_spinor(p)) / det(middle, to_spinor(q))).real() < 0 ? q : -q;
}

}  // namespace

std::optional<TensorPreimage> bilinear_preimage_by_planes(const SphericalQuad& quad) {
  std::array<lvec4, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = to_point(spinor_at(quad.arc[k].p));
  const auto& arc = quad.arc;
  // Planes through corner 0 and the lines of the second meeting points at corners 1 and 3; corner 2 is where
  // its line meets them both.
  const lvec4 low = plane_through(p[0], to_point(spinor_at(second_meeting(arc[0], arc[1]))));
  const lvec4 high = plane_through(p[0], to_point(spinor_at(second_meeting(arc[2], arc[3]))));
  const lvec4 opposite = meet_plane(p[2], low);
  lvec4 b[4] = {p[0], meet_plane(p[1], low), opposite, meet_plane(p[3], high)};
  constexpr long double undetermined = 1e-9L, closes = 1e-10L;
  for (lvec4& c : b) {
    if (!(glm::length(c) > undetermined)) return std::nullopt;
    c = glm::normalize(c);
  }
  if (!(std::abs(glm::dot(glm::normalize(high), b[2])) < closes)) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k) b[k + 1] = along(arc[k], b[k], b[k + 1]);
  if (along(arc[3], b[3], b[0]) != b[0]) return std::nullopt;
  return TensorPreimage(1, 1, {b[0], b[3], b[1], b[2]});
}

}  // namespace rondure
