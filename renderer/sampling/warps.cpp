#include "renderer/sampling/warps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace rondure {

using std::numbers::pi;

dvec3 Frame::to_local(const dvec3& world) const {
  return {glm::dot(world, x), glm::dot(world, y), glm::dot(world, z)};
}

Frame frame_about(const dvec3& n) {
  // A comparison, not the sign bit: -0 and 0 must give the same frame.
  const double sign = n.z < 0.0 ? -1.0 : 1.0;
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

dvec2 sample_disk(dvec2 uv) {
  const double a = 2.0 * uv.x - 1.0;
  const double b = 2.0 * uv.y - 1.0;
  if (a == 0.0 && b == 0.0) return {0.0, 0.0};
  // Concentric squares go to concentric circles; in each of four wedges the angle is linear in b / a or a /
  // b.
  if (std::abs(a) > std::abs(b)) {
    const double angle = 0.25 * pi * (b / a);
    return {a * std::cos(angle), a * std::sin(angle)};
  }
  const double angle = 0.5 * pi - 0.25 * pi * (a / b);
  return {b * std::cos(angle), b * std::sin(angle)};
}

dvec3 sample_cosine_hemisphere(dvec2 uv) {
  const dvec2 d = sample_disk(uv);
  return {d.x, d.y, std::sqrt(std::max(0.0, 1.0 - d.x * d.x - d.y * d.y))};
}

dvec3 sample_sphere(dvec2 uv) {
  const double z = 1.0 - 2.0 * uv.x;
  const double r = 2.0 * std::sqrt(uv.x * (1.0 - uv.x));  // sqrt(1 - z^2) without cancellation at the poles
  const double angle = 2.0 * pi * uv.y;
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace rondure
