#include "renderer/intersect/contact.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <utility>

namespace rondure {
namespace {

constexpr double same_bend = 1e-6;  // in curvature: half of what doubles tell

double size_of(const PlacedSurface& s) { return largest(s.compiled->bounds.high - s.compiled->bounds.low); }

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

// Of the error of t what is not its own rounding.
double own_error(const Hit& hit) { return std::max(0.0, hit.t_error - 0x1p-52 * std::fabs(hit.t)); }

// How far a start on a surface of `start_extent`, in the hit's place, may be from it and know it
// (is_at_start), in t: that the ray has come from far away counts no more there.
double known_within(const PlacedSurface& surface, const Hit& hit, double start_extent) {
  return own_error(hit) * doubt_at(extent_of(surface), start_extent, hit.point, surface.origin);
}

// How much further a is on the ray by where the two are.
double apart_by_points(const Query& q, const Hit& a, const Hit& b) {
  // The squares of a very short direction are zero.
  const double length = largest(q.ray->direction);
  const dvec3 d = q.ray->direction / length;
  return glm::dot(a.point - b.point, d) / (glm::dot(d, d) * length);
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
  if (!(glm::dot(apart, apart) < contact_angle * contact_angle)) return {};
  using enum Contact::Side;
  Contact out{outer, glm::dot(wall.normal, other.normal) > 0.0};
  if (!side_by_bend(surfaces, wall, other, out) && out.alike && is_within(surfaces, wall, other))
    out.side = inner;
  return out;
}

double most_doubt(const PlacedSurface& surface, double widest) {
  if (surface.compiled->bounds.empty()) return 1.0;
  const double extent = extent_of(surface);
  return doubt_at(extent, widest, glm::abs(surface.origin) + extent, surface.origin);
}

double tie_reach(const Query& q, const Hit& hit) {
  return own_error(hit) * q.surfaces[hit.surface].doubt + own_roundings * 0x1p-52 * std::fabs(hit.t);
}

bool are_tied(const Query& q, const Hit& a, const Hit& b) {
  const PlacedSurface &first = q.surfaces[a.surface], &second = q.surfaces[b.surface];
  const double reach =
      std::fmin(known_within(first, a, extent_of(second)), known_within(second, b, extent_of(first)));
  return std::fmin(std::fabs(a.t - b.t), std::fabs(apart_by_points(q, a, b))) <= reach;
}

bool comes_first(const Query& q, const Hit& a, const Hit& b) {
  if (a.surface == b.surface || grazes(q, a) || grazes(q, b)) return nearer(a, b);
  if (!are_tied(q, a, b)) {
    // From far away t may not tell which is nearer; points do.
    if (std::fabs(a.t - b.t) > 0x1p-51 * (std::fabs(a.t) + std::fabs(b.t))) return nearer(a, b);
    return apart_by_points(q, a, b) < 0.0;
  }
  const auto wall = [](const Hit& hit) {
    return Wall{static_cast<unsigned>(hit.surface), hit.point, hit.normal};
  };
  const Wall mine = wall(a), other = wall(b);
  // From so far away that t does not tell even one side of a surface from the other.
  const double apart =
      contact_reach * std::min(size_of(q.surfaces[mine.surface]), size_of(q.surfaces[other.surface]));
  if (!(largest(a.point - b.point) <= apart)) return nearer(a, b);
  const Contact how = contact_of(q.surfaces, mine, other);
  if (how.side == Contact::Side::none) return nearer(a, b);
  return (how.side == Contact::Side::outer) == (glm::dot(other.normal, q.ray->direction) < 0.0);
}

void order_tied(const Query& q, std::vector<Hit>& hits) {
  for (std::size_t k = 1; k < hits.size(); ++k)
    for (std::size_t j = k; j > 0 && are_tied(q, hits[j], hits[j - 1]); --j) {
      if (!comes_first(q, hits[j], hits[j - 1])) break;
      std::swap(hits[j], hits[j - 1]);
    }
}

}  // namespace rondure
