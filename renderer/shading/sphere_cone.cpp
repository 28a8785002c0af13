#include "renderer/shading/sphere_cone.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderer/sampling/warps.h"

namespace rondure {

using std::numbers::pi;

std::optional<SphereCone> sphere_cone(const dvec3& from, const dvec3& center, double radius) {
  // From there on the way to a sampled point is known to 2^-30 of itself, as World::visible wants it.
  constexpr double nearest = 1.0 + 0x1p-16;
  const dvec3 way = center - from;
  const double distance = glm::length(way);
  if (!(radius > 0.0) || !(distance > nearest * radius)) return {};
  const double sine = radius / distance;
  // 1 - cos = sin^2 / (1 + cos) does not cancel, however far the sphere.
  const double height = sine * sine / (1.0 + std::sqrt((1.0 - sine) * (1.0 + sine)));
  return SphereCone{way / distance, distance, radius, height};
}

double SphereCone::pdf() const { return 1.0 / (2.0 * pi * height); }

SphereCone::Sample SphereCone::sample(dvec2 uv) const {
  const double below = uv.x * height;  // 1 - cosine
  const double cosine = 1.0 - below, sine = std::sqrt(below * (2.0 - below));
  const double turn = 2.0 * pi * uv.y;
  const dvec3 local(sine * std::cos(turn), sine * std::sin(turn), cosine);
  // The nearer root of |t d - c| = R, as the product of the roots over the farther one.
  const double off = distance * sine;
  const double half = std::sqrt(std::max(0.0, (radius - off) * (radius + off)));
  return {frame_about(axis).to_world(local),
          (distance - radius) * (distance + radius) / (distance * cosine + half)};
}

}  // namespace rondure
