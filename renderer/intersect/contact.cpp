#include "renderer/intersect/contact.h"

#include <glm/matrix.hpp>

namespace rondure {
namespace {

constexpr double alike = 1e-6;  // in curvature: half of what doubles tell

// How the ellipsoid bends at a point of it: with unit tangents a and b, the form a . bend . b.
dmat3 bend_of(const PlacedSurface& surface, const PatchedSphere& sphere, const dvec3& point) {
  const dmat3 form = glm::transpose(sphere.ellipsoid.inverse) * sphere.ellipsoid.inverse;
  return (1.0 / glm::length(form * (point - surface.origin - sphere.center))) * form;
}

// Which of two closed surfaces is within the other where they touch on the same side, `normal` being that of
// both: the one that bends more. What is not known to be an ellipsoid, or is the other's equal, goes by its
// size, and else by its place in the scene.
Contact nested(const Query& q, unsigned surface, const dvec3& normal) {
  const auto start = static_cast<unsigned>(q.ray->start.surface);
  const CompiledSurface &met = *q.surfaces[surface].compiled, &left = *q.surfaces[start].compiled;
  const PatchedSphere *const sphere = met.lone_sphere(), *const other = left.lone_sphere();
  if (sphere && other) {
    const dmat3 bend = bend_of(q.surfaces[surface], *sphere, q.ray->origin),
                more = bend - bend_of(q.surfaces[start], *other, q.ray->origin);
    const dvec3 aside = std::fabs(normal.x) < 0.5 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0),
                a = glm::normalize(glm::cross(normal, aside)), b = glm::cross(normal, a);
    const double aa = glm::dot(a, more * a), ab = glm::dot(a, more * b), bb = glm::dot(b, more * b),
                 det = aa * bb - ab * ab, least = alike * (glm::dot(a, bend * a) + glm::dot(b, bend * b));
    if (det > least * least) return aa > 0.0 ? Contact::within : Contact::around;
    if (det < -least * least) return Contact::none;
  }
  const double size = largest(met.bounds.high - met.bounds.low),
               most = largest(left.bounds.high - left.bounds.low);
  if (size != most) return size < most ? Contact::within : Contact::around;
  return surface > start ? Contact::within : Contact::around;
}

}  // namespace

Contact contact_with_start(const Query& q, unsigned surface, const dvec3& normal) {
  const dvec3 apart = glm::cross(normal, q.ray->start.normal);
  if (!(glm::dot(apart, apart) < contact_angle * contact_angle)) return Contact::none;
  return glm::dot(normal, q.ray->start.normal) > 0.0 ? nested(q, surface, normal) : Contact::beside;
}

}  // namespace rondure
