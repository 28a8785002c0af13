#include "renderer/study/singular_sites.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/normals/direction.h"
#include "renderer/normals/estimator.h"

namespace rondure {
namespace {

constexpr long pieces_a_patch = 20000;

dvec2 middle_of(const Net& net) {
  return std::holds_alternative<TensorNet>(net) ? dvec2(0.5, 0.5) : dvec2(1.0 / 3.0, 1.0 / 3.0);
}

double snapped(double x, double close) {
  return std::abs(x) < close ? 0.0 : std::abs(x - 1.0) < close ? 1.0 : x;
}

// Where a zero that was found without proof is meant to lie: at a corner, if that is one; on the boundary, if
// it is there to some roundings. Zeros of higher order are found to a root of those only.
dvec2 placed(const Net& net, dvec2 found) {
  const dvec2 corner(snapped(found.x, 1e-4), snapped(found.y, 1e-4));
  const bool ends = corner.x == std::round(corner.x) && corner.y == std::round(corner.y);
  if (ends && germ_of(net, corner).order > 0) return corner;
  return {snapped(found.x, 1e-9), snapped(found.y, 1e-9)};
}

std::string place_of(const Net& net, dvec2 p) {
  const bool u_end = p.x == 0.0 || p.x == 1.0, v_end = p.y == 0.0 || p.y == 1.0;
  if (std::holds_alternative<TensorNet>(net))
    return u_end && v_end ? "corner" : u_end || v_end ? "side" : "inside";
  if ((p.x == 1.0 && p.y == 0.0) || (p.x == 0.0 && p.y == 1.0) || (p.x == 0.0 && p.y == 0.0)) return "corner";
  return p.x == 0.0 || p.y == 0.0 || std::abs(p.x + p.y - 1.0) < 1e-12 ? "side" : "inside";
}

// The directions along the two sides that meet in a corner, inward; u and v elsewhere.
std::pair<dvec2, dvec2> sides_at(const Net& net, dvec2 at) {
  const bool triangle = std::holds_alternative<TriangleNet>(net);
  if (triangle && at.x == 1.0) return {{-1.0, 1.0}, {-1.0, 0.0}};
  if (triangle && at.y == 1.0) return {{0.0, -1.0}, {1.0, -1.0}};
  return {{at.x == 1.0 ? -1.0 : 1.0, 0.0}, {0.0, at.y == 1.0 ? -1.0 : 1.0}};
}

// A tangent that vanishes is short beside the patch, not beside the other tangent.
std::string kind_of(const Net& net, dvec2 at, const NormalGerm& germ) {
  if (germ.side_order > 0) return "collapsed side";
  const SurfaceJet here = surface_jet(net, at.x, at.y);
  const dvec2 m = middle_of(net);
  const SurfaceJet inside = surface_jet(net, m.x, m.y);
  const double size = glm::length(inside.du) + glm::length(inside.dv);
  const auto [first, second] = sides_at(net, at);
  const dvec3 a = first.x * here.du + first.y * here.dv, b = second.x * here.du + second.y * here.dv;
  const bool no_u = glm::length(a) < 1e-9 * size, no_v = glm::length(b) < 1e-9 * size;
  if (no_u && no_v) return "vanishing tangents";
  if (no_u || no_v) return "vanishing tangent";
  if (place_of(net, at) != "corner") return "parallel tangents";
  return glm::dot(a, b) > 0.0 ? "corner of 0 degrees" : "corner of 180 degrees";
}

SingularSite site_at(const Net& net, int patch, dvec2 at) {
  SingularSite site;
  site.patch = patch;
  site.at = at;
  site.point = net_point(net, at.x, at.y);
  site.place = place_of(net, at);
  site.germ = germ_of(net, at);
  site.kind = kind_of(net, at, site.germ);
  site.limit = limit_normal(net, at.x, at.y);
  const dvec2 way = middle_of(net) - at;
  site.inward = glm::length(way) > 1e-3 ? glm::normalize(way) : glm::normalize(dvec2(1.0, 0.4));
  return site;
}

struct Side {
  dvec2 ends[2];
};

std::vector<Side> sides_of(const Net& net) {
  const dvec2 o(0, 0), a(1, 0), b(0, 1), c(1, 1);
  if (std::holds_alternative<TensorNet>(net)) return {{{o, b}}, {{a, c}}, {{o, a}}, {{b, c}}};
  return {{{o, b}}, {{o, a}}, {{a, b}}};
}

}  // namespace

SiteSearch singular_sites(const Surface& surface) {
  SiteSearch search;
  for (std::size_t k = 0; k < surface.patches.size(); ++k) {
    const Net& net = surface.patches[k];
    const int patch = static_cast<int>(k);
    const std::size_t first = search.sites.size();
    const auto add = [&](dvec2 p, SingularPoint::Proof proof, double within) {
      for (std::size_t s = first; s < search.sites.size(); ++s)
        if (glm::distance(search.sites[s].at, p) < 1e-6) return;
      search.sites.push_back(site_at(net, patch, p));
      search.sites.back().proof = proof;
      search.sites.back().within = within;
      // Where N's derivative has rank two (Whitney 1944).
      if (proof == SingularPoint::Proof::unique) search.sites.back().kind = "cross-cap";
    };
    constexpr auto exact = SingularPoint::Proof::exact;
    for (const Side& side : sides_of(net)) {
      const dvec2 middle = 0.5 * (side.ends[0] + side.ends[1]);
      if (germ_of(net, middle).side_order == 0) continue;
      add(middle, exact, 0.0);
      add(side.ends[0], exact, 0.0);
      add(side.ends[1], exact, 0.0);
    }
    Surface alone;
    alone.patches.push_back(net);
    const Regularity found = regularity_of(alone, pieces_a_patch);
    for (const SingularPoint& s : found.singular) {
      const dvec2 at(s.u, s.v);
      add(s.proof == SingularPoint::Proof::none ? placed(net, at) : at, s.proof, s.within);
    }
    (found.complete ? search.proved : search.undecided) += 1;
    search.pieces += found.pieces;
  }
  return search;
}

}  // namespace rondure
