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

double size_of(const PlacedSurface& s) { return largest(s.compiled->bounds.high - s.compiled->bounds.low); }

// Which of two closed surfaces is within the other where they touch on the same side, `normal` being that of
// both: the one that bends more. What is not known to be an ellipsoid, or is the other's equal, goes by its
// size, and else by its place in the scene.
Contact nested(const PlacedSurface* surfaces, const Wall& wall, const Wall& other) {
  const PlacedSurface &mine = surfaces[wall.surface], &others = surfaces[other.surface];
  const PatchedSphere *const sphere = mine.compiled->lone_sphere(), *const second =
                                                                        others.compiled->lone_sphere();
  if (sphere && second) {
    const dvec3& normal = wall.normal;
    const dmat3 bend = bend_of(mine, *sphere, wall.point),
                more = bend - bend_of(others, *second, other.point);
    const dvec3 aside = std::fabs(normal.x) < 0.5 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0),
                a = glm::normalize(glm::cross(normal, aside)), b = glm::cross(normal, a);
    const double aa = glm::dot(a, more * a), ab = glm::dot(a, more * b), bb = glm::dot(b, more * b),
                 det = aa * bb - ab * ab, least = alike * (glm::dot(a, bend * a) + glm::dot(b, bend * b));
    if (det > least * least) return aa > 0.0 ? Contact::within : Contact::around;
    if (det < -least * least) return Contact::none;
  }
  const double size = size_of(mine), most = size_of(others);
  if (size != most) return size < most ? Contact::within : Contact::around;
  return wall.surface > other.surface ? Contact::within : Contact::around;
}

// Of errors, how much a start at the point adds.
double doubt_of(const PlacedSurface& surface, const dvec3& point) {
  const double size = size_of(surface),
               moved = 0x1p-51 * size + 0x1p-52 * (largest(point) + largest(surface.origin));
  return 1.0 + 2.0 * moved / (0x1p-51 * size);
}

// So nearly along the wall that its two crossings may be tied with each other.
bool grazes(const Query& q, const Hit& hit) {
  const dvec3& d = q.ray->direction;
  const double along = glm::dot(hit.normal, d);
  return along * along < contact_reach * contact_reach * glm::dot(d, d);
}

}  // namespace

Contact contact_of(const PlacedSurface* surfaces, const Wall& wall, const Wall& other) {
  const dvec3 apart = glm::cross(wall.normal, other.normal);
  if (!(glm::dot(apart, apart) < contact_angle * contact_angle)) return Contact::none;
  return glm::dot(wall.normal, other.normal) > 0.0 ? nested(surfaces, wall, other) : Contact::beside;
}

double contact_doubt(const PlacedSurface& surface, const Hit& hit) {
  return hit.t_error * doubt_of(surface, hit.point);
}

double most_doubt(std::span<const PlacedSurface> surfaces) {
  double most = 1.0;
  for (const PlacedSurface& s : surfaces) {
    const Box& bounds = s.compiled->bounds;
    if (!bounds.empty())
      most = std::max(
          most, doubt_of(s, glm::abs(s.origin) + glm::max(glm::abs(bounds.low), glm::abs(bounds.high))));
  }
  return most;
}

bool are_tied(const PlacedSurface* surfaces, const Hit& a, const Hit& b) {
  const double first = contact_doubt(surfaces[a.surface], a), second = contact_doubt(surfaces[b.surface], b);
  return std::fabs(a.t - b.t) <= std::min(first + second, tie_reach * std::min(first, second));
}

bool comes_first(const Query& q, const Hit& a, const Hit& b) {
  if (a.surface == b.surface || !are_tied(q.surfaces, a, b) || grazes(q, a) || grazes(q, b))
    return nearer(a, b);
  const auto wall = [](const Hit& hit) {
    return Wall{static_cast<unsigned>(hit.surface), hit.point, hit.normal};
  };
  const Wall mine = wall(a), other = wall(b);
  const PlacedSurface &first = q.surfaces[mine.surface], &second = q.surfaces[other.surface];
  if (!first.compiled->closed || !second.compiled->closed) return nearer(a, b);
  // From so far away that t does not tell one side of a surface from the other, points still do.
  const double apart = contact_reach * std::min(size_of(first), size_of(second));
  if (!(largest(a.point - b.point) <= apart)) return nearer(a, b);
  const bool into = glm::dot(a.normal, q.ray->direction) < 0.0;
  switch (contact_of(q.surfaces, mine, other)) {
    case Contact::beside:
    case Contact::within:
      return !into;
    case Contact::around:
      return into;
    default:
      return nearer(a, b);
  }
}

}  // namespace rondure
