#include "renderer/intersect/hit_order.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "renderer/bezier/quotient.h"

namespace rondure {
namespace {

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

// Whether they are by more than the hits' errors and the points' rounding.
bool are_apart(const Query& q, const Hit& a, const Hit& b) {
  const PlacedSurface &first = q.surfaces[a.surface], &second = q.surfaces[b.surface];
  const double size = largest(a.point) + largest(b.point) + extent_of(first) + extent_of(second);
  const double rounding = quotient(0x1p-51 * size, largest(q.ray->direction));
  return std::fabs(apart_by_points(q, a, b)) > own_error(a) + own_error(b) + rounding;
}

// Whether t is so large that it may not tell which is nearer.
bool have_one_t(const Hit& a, const Hit& b) {
  return std::fabs(a.t - b.t) <= 0x1p-51 * (std::fabs(a.t) + std::fabs(b.t));
}

// So nearly along the wall that its two crossings may be tied with each other.
bool grazes(const Query& q, const Hit& hit) {
  const dvec3 d = q.ray->direction / largest(q.ray->direction);
  const double along = glm::dot(hit.normal, d);
  return along * along < contact_reach * contact_reach * glm::dot(d, d);
}

// Of hits in order of t, those that are tied.
void order_tied(const Query& q, std::vector<Hit>& hits) {
  for (std::size_t k = 1; k < hits.size(); ++k)
    for (std::size_t j = k; j > 0 && are_tied(q, hits[j], hits[j - 1]); --j) {
      if (!comes_first(q, hits[j], hits[j - 1])) break;
      std::swap(hits[j], hits[j - 1]);
    }
}

}  // namespace

bool nearer(const Hit& a, const Hit& b) {
  if (a.t != b.t) return a.t < b.t;
  if (a.surface != b.surface) return a.surface < b.surface;
  if (a.patch != b.patch) return a.patch < b.patch;
  // Where two leaves of one patch meet, both find the root, a last bit apart, or only what follows from it
  // is.
  if (a.u != b.u) return a.u < b.u;
  if (a.v != b.v) return a.v < b.v;
  if (a.t_error != b.t_error) return a.t_error < b.t_error;
  for (const dvec3 Hit::*vector : {&Hit::point, &Hit::normal})
    for (int k = 0; k < 3; ++k)
      if ((a.*vector)[k] != (b.*vector)[k]) return (a.*vector)[k] < (b.*vector)[k];
  return false;
}

bool are_walls_of_one_t(const Query& q, const Hit& a, const Hit& b) {
  return have_one_t(a, b) && are_apart(q, a, b) && !grazes(q, a) && !grazes(q, b);
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
  // From far away t may not tell which is nearer; points do.
  if (a.surface == b.surface)
    return are_walls_of_one_t(q, a, b) ? apart_by_points(q, a, b) < 0.0 : nearer(a, b);
  if (grazes(q, a) || grazes(q, b)) return nearer(a, b);
  if (!are_tied(q, a, b)) return have_one_t(a, b) ? apart_by_points(q, a, b) < 0.0 : nearer(a, b);
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

std::vector<Hit> in_order(const Query& q, const std::vector<Hit>& hits, const std::vector<int>& signs) {
  std::vector<std::size_t> order(hits.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return nearer(hits[a], hits[b]); });
  double widest = 0.0;
  for (const Hit& hit : hits) widest = std::max(widest, hit.t_error);
  std::vector<Hit> out;
  std::vector<int> out_signs;
  for (const std::size_t k : order) {
    // Neighbouring patches (and leaves) both report a point on their seam: same surface, same crossing, same
    // t to rounding.
    bool known = false;
    for (std::size_t j = out.size(); j-- > 0 && !known;) {
      if (hits[k].t - out[j].t > hits[k].t_error + widest) break;
      if (hits[k].t - out[j].t > hits[k].t_error + out[j].t_error) continue;
      const bool same_way = signs[k] == out_signs[j] || signs[k] == 0 || out_signs[j] == 0;
      known = out[j].surface == hits[k].surface && same_way && !are_walls_of_one_t(q, hits[k], out[j]);
    }
    if (known) continue;
    out.push_back(hits[k]);
    out_signs.push_back(signs[k]);
  }
  order_tied(q, out);
  return out;
}

}  // namespace rondure
