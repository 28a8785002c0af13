// The greatest least value of linear functions on the sphere, by enumeration: at the maximum one function is
// stationary, or two are equal and stationary along their circle, or three are equal.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "renderer/projective/spherical_quad.h"

namespace rondure {
namespace {

// slope . c + offset
struct Margin {
  lvec3 slope;
  long double offset;
};

std::vector<Margin> margins_of(const SphericalQuad& quad) {
  std::vector<Margin> margins;
  for (const SphereArc& arc : quad.arc) {
    margins.push_back({arc.p, 1});  // the weight of the corner: positive away from the opposite of c
    // The plane of the circle, its normal on the region's side: the chord is to the left of the tangent.
    const lvec3 normal = glm::normalize(glm::cross(arc.start_tangent(), arc.q - arc.p));
    // The opposite of c lies outside the cap when normal . (-c) < normal . p.
    margins.push_back({normal, glm::dot(normal, arc.p)});
  }
  return margins;
}

class CentreSearch {
 public:
  explicit CentreSearch(std::vector<Margin> margins) : margins_(std::move(margins)) {}

  void add(const lvec3& c) {
    if (!(glm::dot(c, c) > 0)) return;
    const lvec3 unit = glm::normalize(c);
    long double least = HUGE_VALL;
    for (const Margin& m : margins_) least = std::min(least, glm::dot(m.slope, unit) + m.offset);
    if (least > best_margin_) best_margin_ = least, best_ = unit;
  }

  // Where a and b are equal, and most of it in the direction of a.
  void add_pair(const Margin& a, const Margin& b) {
    const lvec3 n = a.slope - b.slope;
    const long double nn = glm::dot(n, n);
    if (!(nn > 1e-24L)) return;
    const lvec3 foot = n * ((b.offset - a.offset) / nn);
    const lvec3 along = a.slope - n * (glm::dot(a.slope, n) / nn);
    const long double room = 1 - glm::dot(foot, foot), length = glm::length(along);
    if (room >= 0 && length > 1e-12L) add(foot + along * (std::sqrt(room) / length));
  }

  void add_triple(const Margin& a, const Margin& b, const Margin& c) {
    const lvec3 n = a.slope - b.slope, m = a.slope - c.slope, along = glm::cross(n, m);
    const long double s = b.offset - a.offset, t = c.offset - a.offset, aa = glm::dot(along, along);
    if (!(aa > 1e-24L)) return;
    const lvec3 foot = (glm::cross(m, along) * s + glm::cross(along, n) * t) / aa;
    const long double room = 1 - glm::dot(foot, foot);
    if (room < 0) return;
    add(foot + along * std::sqrt(room / aa));
    add(foot - along * std::sqrt(room / aa));
  }

  const lvec3& best() const { return best_; }

 private:
  std::vector<Margin> margins_;
  lvec3 best_{0, 0, -1};
  long double best_margin_ = -HUGE_VALL;
};

}  // namespace

lvec3 best_centre(const SphericalQuad& quad) {
  const std::vector<Margin> m = margins_of(quad);
  CentreSearch search(m);
  for (std::size_t i = 0; i < m.size(); ++i) {
    search.add(m[i].slope);
    for (std::size_t j = 0; j < i; ++j) {
      search.add_pair(m[i], m[j]);
      for (std::size_t k = 0; k < j; ++k) search.add_triple(m[i], m[j], m[k]);
    }
  }
  return search.best();
}

}  // namespace rondure
