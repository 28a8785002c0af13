#include "tests/intersect/verdict.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

#include "renderer/intersect/local_ray.h"
#include "tests/intersect/sphere_reference.h"

namespace rondure {
namespace {

double rounding_of(double t, double unit) { return 0x1p-50 * (std::fabs(t) + unit); }

}  // namespace

SphereVerdict judge_by_sphere(const ClosedModel& model, const Ray& ray, const std::vector<Hit>& hits) {
  // Scaled by a power of two: rounding a direction moves the far end of a ray from 10^8 radii away.
  const int exponent = std::ilogb(largest(ray.direction));
  dvec3 direction;
  for (int k = 0; k < 3; ++k) direction[k] = std::ldexp(ray.direction[k], -exponent);
  const SphereReference exact = sphere_reference(ray.origin, direction, model.surface.origin, model.radius);
  std::vector<double> expected;
  if (exact.clearance < 0.0)
    std::copy_if(std::begin(exact.t), std::end(exact.t), std::back_inserter(expected),
                 [](double t) { return t >= 0.0; });
  SphereVerdict out;
  out.in_band = std::fabs(exact.clearance) <= model.band;
  out.counted = hits.size() == expected.size();
  out.many = hits.size() > 2;
  if (out.in_band || !out.counted) return out;
  const double unit = model.radius / glm::length(direction);
  // What a hit may claim to be wrong, for what the band makes of it: of the size of what it bounds, that is.
  // Both are made of the same roundings; a solver may count twice as many. The rest is slack, not derived.
  constexpr double modest = 16.0;
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const double t = std::ldexp(hits[k].t, exponent), claimed = std::ldexp(hits[k].t_error, exponent);
    const double moved = 2.0 * model.band * unit / exact.cosine, rounding = rounding_of(t, unit);
    out.placed = out.placed && std::fabs(t - expected[k]) <= moved + claimed + rounding;
    out.placed = out.placed && claimed <= modest * (moved + rounding);
  }
  return out;
}

Verdict judge(const Surface& surface, const Ray& ray, const std::vector<Hit>& hits, double radius,
              double band, double doubt) {
  const double longest = largest(ray.direction);
  const double speed = longest * glm::length(ray.direction / longest), unit = radius / speed;
  const auto rounding = [&](double t) { return rounding_of(t, unit); };
  const oracle::Meeting meeting = oracle::meet(surface, ray);
  // Neighbours' roots at a seam differ by the ray's distance from it, and by the two nets', both of which
  // rounding makes, over the cosine.
  const std::vector<oracle::Crossing> found = oracle::crossings(meeting, 0x1p-44 * unit, 0x1p-50 * unit);

  Verdict out;
  out.certified = !meeting.exhausted;
  // A root moves along the ray by band / cosine, and near a touching place by the square root of twice the
  // band times the radius of curvature there: the surface's own, mostly, and more where it is flat, but never
  // past the nearest crossing.
  const auto near_graze = [&](double t) {
    constexpr double flatness = 16.0;  // the root of a radius of curvature, in the surface's radii
    const double reach = 4.0 * std::sqrt(band * radius) / speed;
    for (const oracle::Graze& g : meeting.grazes) {
      if (g.depth > band || std::fabs(g.t - t) > flatness * reach) continue;
      if (std::fabs(g.t - t) <= reach) return true;
      const double low = std::min(g.t, t), high = std::max(g.t, t), room = rounding(t);
      const auto between = [&](const oracle::Crossing& c) { return c.t > low + room && c.t < high - room; };
      if (std::none_of(found.begin(), found.end(), between)) return true;
    }
    return false;
  };
  // The parameters of 50 digits that a ray in the plane of a side has there are zero but for those.
  constexpr double oracle_rounding = 0x1p-150;
  // A ray through a singular corner, or in the tangent plane of a vertex, may take more pieces than there is
  // patience for: then nothing is said.
  if (meeting.exhausted) return out;
  std::vector<int> told(found.size(), 0);
  std::vector<bool> doubtful(found.size(), false);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const oracle::Crossing& c = found[k];
    const bool beside = c.outside > oracle_rounding;  // within rounding of patches, and in none
    const bool start = std::fabs(c.t - ray.t_min) <= doubt || std::fabs(c.t - ray.t_max) <= doubt;
    doubtful[k] = beside || start || c.touches || c.multiplicity != 1 || near_graze(c.t);
    out.in_band = out.in_band || (doubtful[k] && (!beside || start || c.touches || c.multiplicity != 1));
    out.certified = out.certified && c.certified;
  }
  for (const Hit& hit : hits) {
    std::size_t best = found.size();
    const auto awaits = [&](std::size_t k) { return !doubtful[k] && told[k] == 0; };
    const auto is_better = [&](std::size_t k) {
      if (best == found.size()) return true;
      // At a glancing seam the neighbour's root, outside its patch by rounding, may be the nearer one.
      if (awaits(k) != awaits(best)) return awaits(k);
      return (told[k] == 0 && told[best] > 0) ||
             std::fabs(found[k].t - hit.t) < std::fabs(found[best].t - hit.t);
    };
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double off = std::max({found[k].low - hit.t, hit.t - found[k].high, 0.0});
      const double allowed =
          hit.t_error + rounding(hit.t) + (doubtful[k] ? 4.0 * std::sqrt(band * radius) / speed : 0.0);
      if (off <= allowed && is_better(k)) best = k;
    }
    if (best < found.size()) {
      ++told[best];
    } else if (near_graze(hit.t)) {
      out.in_band = true;
    } else {
      out.right = false;
      out.text +=
          fmt::format(" a hit at t = {:.17g} (error {:.2g}, patch {}, u {:.17g}, v {:.17g}) that is none;",
                      hit.t, hit.t_error, hit.patch, hit.u, hit.v);
    }
  }
  for (std::size_t k = 0; k < found.size(); ++k) {
    const oracle::Crossing& c = found[k];
    const bool ahead = c.t >= ray.t_min && c.t <= ray.t_max;
    if (doubtful[k] || told[k] == (ahead ? 1 : 0)) continue;
    out.right = false;
    out.text +=
        fmt::format(" crossing at t = {:.17g} (patch {} of {}, outside {:.2g}, cosine {:.3g}) told {} times;",
                    c.t, c.patches.front(), c.patches.size(), c.outside, c.cosine, told[k]);
  }
  for (const oracle::Root& r : meeting.roots)
    out.seen += fmt::format(
        "\n  root t {:.17g}, patch {} at ({:.17g}, {:.17g}), outside {:.3g}, cosine {:.3g}, way {}", r.t,
        r.patch, r.u, r.v, r.outside, r.cosine, r.way);
  for (const oracle::Graze& g : meeting.grazes)
    out.seen += fmt::format("\n  graze t {:.17g}, patch {}, depth {:.3g} radii, outside {:.3g}", g.t, g.patch,
                            g.depth / radius, g.outside);
  return out;
}

bool touches_edge(const Surface& surface, const Ray& ray) {
  // Of the parameters, 512 roundoffs: rounding moves a root by some tens, over the patch's speed there. That
  // is zero at singular corners, so no number is a bound; the test counts what this excuses, and bounds it.
  constexpr double glancing = 0x1p-8, rounding = 0x1p-44;
  // Where the cosine is the square root of rounding, roots are that far beside the edge too.
  const std::vector<oracle::Root> roots = oracle::meet(surface, ray, 0x1p-46, 0x1p-22).roots;
  const auto is_beside = [](const oracle::Root& root) {
    return root.outside > 0.0 && root.outside * root.cosine <= rounding;
  };
  for (const oracle::Root& a : roots) {
    if (!is_beside(a)) continue;
    if (a.cosine <= glancing) return true;
    for (const oracle::Root& b : roots)
      if (is_beside(b) && a.way * b.way < 0 &&
          std::fabs(a.t - b.t) * std::fmin(a.cosine, b.cosine) <= rounding * std::fmax(1.0, std::fabs(a.t)))
        return true;
  }
  return false;
}

}  // namespace rondure
