#include "renderer/intersect/contact.h"

#include <cmath>
#include <glm/matrix.hpp>

namespace rondure {
namespace {

constexpr double same_bend = 1e-6;  // in curvature: half of what doubles tell

// How an ellipsoid is above its tangent plane, the wall's normal being up: with unit tangents a and b, the
// form a . rise . b. The patches' normal, which is the wall's, may point inward.
dmat3 rise_of(const PlacedSurface& surface, const PatchedSphere& sphere, const Wall& wall) {
  const dmat3 form = glm::transpose(sphere.ellipsoid.inverse) * sphere.ellipsoid.inverse;
  const dvec3 outward = form * (wall.point - surface.origin - sphere.center);
  const double down = glm::dot(outward, wall.normal) > 0.0 ? -1.0 : 1.0;
  return (down / glm::length(outward)) * form;
}

// On which side of the other the wall is because both bend as they do; none where they cross. False where
// that is not known, or does not tell.
bool side_by_bend(const PlacedSurface* surfaces, const Wall& wall, const Wall& other, Contact& out) {
  const PlacedSurface &mine = surfaces[wall.surface], &others = surfaces[other.surface];
  const PatchedSphere *const sphere = mine.compiled->lone_sphere(), *const second =
                                                                        others.compiled->lone_sphere();
  if (!sphere || !second) return false;
  const dvec3& normal = other.normal;
  const dmat3 first = rise_of(mine, *sphere, wall), under = rise_of(others, *second, other),
              above = (out.alike ? first : -first) - under;
  const dvec3 aside = std::fabs(normal.x) < 0.5 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0),
              a = glm::normalize(glm::cross(normal, aside)), b = glm::cross(normal, a);
  const double aa = glm::dot(a, above * a), ab = glm::dot(a, above * b), bb = glm::dot(b, above * b),
               det = aa * bb - ab * ab,
               least = same_bend * (std::fabs(glm::dot(a, first * a)) + std::fabs(glm::dot(b, first * b)));
  if (std::fabs(det) <= least * least) return false;
  using enum Contact::Side;
  out.side = det < 0.0 ? none : aa > 0.0 ? outer : inner;
  return true;
}

// Which is within the other.
bool is_within(const PlacedSurface* surfaces, const Wall& wall, const Wall& other) {
  const PlacedSurface &mine = surfaces[wall.surface], &others = surfaces[other.surface];
  if (mine.compiled->closed != others.compiled->closed) return mine.compiled->closed;
  const double size = size_of(mine), most = size_of(others);
  return size != most ? size < most : wall.surface > other.surface;
}

}  // namespace

Contact contact_of(const PlacedSurface* surfaces, const Wall& wall, const Wall& other) {
  const dvec3 apart = glm::cross(wall.normal, other.normal);
  if (!(glm::dot(apart, apart) < contact_angle * contact_angle)) return {};
  using enum Contact::Side;
  Contact out{outer, glm::dot(wall.normal, other.normal) > 0.0};
  if (!side_by_bend(surfaces, wall, other, out) && out.alike && is_within(surfaces, wall, other))
    out.side = inner;
  return out;
}

}  // namespace rondure
