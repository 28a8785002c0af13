#include "renderer/plugin/build_surface.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "renderer/api/utf8.h"
#include "renderer/bezier/bernstein.h"
#include "renderer/continuity/seams.h"
#include "renderer/intersect/ellipsoid.h"
#include "renderer/intersect/query.h"
#include "renderer/plugin/call_plugin.h"

namespace rondure {
namespace {

bool is_finite(const dvec3& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }
bool is_finite(const dvec4& x) { return is_finite(dvec3(x)) && std::isfinite(x.w); }

bool is_degree(int n) { return n >= 1 && n <= max_degree; }

std::string defect_of(const std::vector<dvec4>& points, int expected) {
  if (points.size() != static_cast<std::size_t>(expected))
    return fmt::format("has {} control points, not {}", points.size(), expected);
  for (const dvec4& p : points) {
    if (!is_finite(p)) return "has a control point that is not finite";
  }
  return "";
}

std::string defect_of(const TensorNet& net) {
  if (!is_degree(net.m) || !is_degree(net.n))
    return fmt::format("has degree ({}, {}), and degrees are 1 to {}", net.m, net.n, max_degree);
  return defect_of(net.points, (net.m + 1) * (net.n + 1));
}

std::string defect_of(const TriangleNet& net) {
  if (!is_degree(net.n)) return fmt::format("has degree {}, and degrees are 1 to {}", net.n, max_degree);
  return defect_of(net.points, triangle_size(net.n));
}

std::string defect_of(const Guide& guide) {
  if (guide.curve.size() < 2) return "is a curve of less than two control points";
  if (!std::isfinite(guide.end_balls) || guide.end_balls < 0.0) return "has balls of no size";
  return defect_of(guide.curve, static_cast<int>(guide.curve.size()));
}

std::string defect_of(const SideJoin& join, const std::vector<Net>& patches) {
  for (const auto& [patch, side] :
       {std::pair{join.patch, join.side}, std::pair{join.other, join.other_side}}) {
    if (patch < 0 || static_cast<std::size_t>(patch) >= patches.size())
      return fmt::format("is of a patch {}, and there are {}", patch, patches.size());
    const int sides = side_count(patches[static_cast<std::size_t>(patch)]);
    if (side < 0 || side >= sides)
      return fmt::format("is of a side {}, and patch {} has {}", side, patch, sides);
  }
  return "";
}

// What is wrong with the surface; empty when nothing is.
std::string defect_of(const Surface& surface) {
  if (!is_finite(surface.origin)) return "has an origin that is not finite";
  if (surface.ellipsoid) {
    if (!surface.patches.empty()) return "is an ellipsoid and patches at once";
    for (int j = 0; j < 3; ++j) {
      if (!is_finite((*surface.ellipsoid)[j])) return "is an ellipsoid that is not finite";
    }
    if (is_too_flat(*surface.ellipsoid))
      return fmt::format("is an ellipsoid of semi-axes in a ratio above {:.0e}", flattest_ellipsoid);
  } else if (surface.patches.empty()) {
    return "has no patches";
  }
  for (std::size_t k = 0; k < surface.patches.size(); ++k) {
    const std::string defect = std::visit([](const auto& net) { return defect_of(net); }, surface.patches[k]);
    if (!defect.empty()) return fmt::format("has a patch {} that {}", k, defect);
  }
  for (const SideJoin& join : surface.joins) {
    const std::string defect = defect_of(join, surface.patches);
    if (!defect.empty()) return "has a join that " + defect;
  }
  for (const auto& [part, guides] : surface.guides) {
    for (const Guide& guide : guides) {
      const std::string defect = defect_of(guide);
      if (!defect.empty()) return fmt::format("has a guide in \"{}\" that {}", printable(part), defect);
    }
  }
  return "";
}

}  // namespace

Surface build_surface(const SurfaceFamily& family, Params& params) {
  const std::string who = fmt::format("the family \"{}\"", printable(family.name));
  Surface surface = call_plugin(params, who, [&] { return family.build(params); });
  const std::string defect = defect_of(surface);
  if (!defect.empty()) params.fail(fmt::format("{} made a surface that {}", who, defect));
  for (Net& net : surface.patches) bring_near_one(net);
  return surface;
}

}  // namespace rondure
