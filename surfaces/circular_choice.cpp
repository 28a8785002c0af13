#include "surfaces/circular_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/projective/orientation.h"

namespace rondure {
namespace {

// With d/du x d/dv turned round.
Preimage mirrored(const Preimage& preimage) {
  if (const auto* t = std::get_if<TensorPreimage>(&preimage)) {
    TensorPreimage out(t->m, t->n);
    for (int i = 0; i <= t->m; ++i) {
      for (int j = 0; j <= t->n; ++j) out.at(i, j) = t->at(t->m - i, j);
    }
    return out;
  }
  const auto& t = std::get<TrianglePreimage>(preimage);
  TrianglePreimage out(t.n);
  for (int i = 0; i <= t.n; ++i) {
    for (int j = 0; j <= t.n - i; ++j) out.at(i, j) = t.at(j, i);
  }
  return out;
}

bool weights_positive(const Net& net) {
  const std::vector<dvec4>& points = points_of(net);
  return std::all_of(points.begin(), points.end(), [](const dvec4& p) { return p.w > 0.0; });
}

}  // namespace

std::vector<Root> roots_of(const Complex& holonomy) {
  const bool either = std::abs(holonomy + 1.0L) <= closes;
  return either ? std::vector<Root>{Root::least, Root::other} : std::vector<Root>{Root::least};
}

bool all_straight(const std::vector<SphereArc>& arcs) {
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    const lvec3 in = arcs[k].end_tangent(), out = arcs[(k + 1) % arcs.size()].start_tangent();
    // Corners are good to ten digits, tangents to the share that arcs have of the circle.
    if (glm::length(in - out) > 1e-6L) return false;
  }
  return true;
}

Surface best_image(const Params& params, const std::vector<Preimage>& candidates) {
  Surface surface;
  for (const Preimage& candidate : candidates) {
    if (!regularity(candidate).regular) continue;
    Net net = sphere_image(candidate);
    const bool positive = weights_positive(net);
    if (surface.patches.empty() || positive) surface.patches = {std::move(net)};
    if (positive) break;
  }
  if (!surface.patches.empty()) return surface;
  const Preimage& first = candidates.front();
  if (regularity(mirrored(first)).regular)
    params.fail("corners", "the corners must run counter-clockwise, seen from outside; these run clockwise");
  const dvec2 at = regularity(first).worst;
  params.fail("corners",
              fmt::format("the patch between these arcs folds, near (u, v) = ({:.4g}, {:.4g}): "
                          "interior angles should be less than 180 degrees and arcs must not cross",
                          at.x, at.y));
}

}  // namespace rondure
