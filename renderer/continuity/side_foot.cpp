#include "renderer/continuity/side_foot.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"

namespace rondure {

dvec3 point_on_side(const Net& net, int side, double t) {
  const dvec2 uv = side_point(net, side, t);
  return net_point(net, uv.x, uv.y);
}

SideFoot foot_on_side(const Net& net, int side, const dvec3& p, double guess) {
  const auto at = [&](double t) { return SideFoot{t, glm::distance(point_on_side(net, side, t), p)}; };
  const dvec2 d = side_point(net, side, 1.0) - side_point(net, side, 0.0);
  constexpr int samples = 16, most_steps = 60, most_halvings = 20;
  SideFoot best = at(guess);
  // What Newton's method gains from a place that is right but for rounding is nothing.
  const SideFoot first = best;
  for (int k = 0; k <= samples && best.distance > 0.0; ++k) {
    const SideFoot tried = at(static_cast<double>(k) / samples);
    if (tried.distance < 0.5 * best.distance) best = tried;
  }
  for (int step = 0; step < most_steps && best.distance > 0.0; ++step) {
    const dvec2 uv = side_point(net, side, best.t);
    const SurfaceJet jet = surface_jet(net, uv.x, uv.y);
    const dvec3 slope = d.x * jet.du + d.y * jet.dv;
    double move = glm::dot(p - jet.point, slope) / glm::dot(slope, slope);
    if (!std::isfinite(move)) break;
    SideFoot next = best;
    for (int k = 0; k < most_halvings && !(next.distance < best.distance); ++k, move *= 0.5)
      next = at(std::clamp(best.t + move, 0.0, 1.0));
    if (!(next.distance < best.distance)) break;
    best = next;
  }
  return best.distance < 0.5 * first.distance ? best : first;
}

}  // namespace rondure
