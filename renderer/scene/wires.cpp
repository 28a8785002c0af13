#include "renderer/scene/wires.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/bezier/tube.h"
#include "renderer/projective/ball.h"

namespace rondure {

// Points that share a cell of a thousandth of the radius cannot be told apart in a picture. What rounding
// puts into two cells is drawn twice, which does no harm.
Wires::Place Wires::place(const dvec3& point) const {
  // Of the thinnest radii that would be zero.
  const double cell = std::fmax(tube_accuracy * radius_, std::numeric_limits<double>::min());
  return {std::round(point.x / cell), std::round(point.y / cell), std::round(point.z / cell)};
}

void Wires::add_ball(const dvec3& point, double balls) {
  if (!(balls > 0.0)) return;
  const auto [found, fresh] = ball_at_.try_emplace(place(point), balls_.size());
  if (fresh) balls_.emplace_back(point, balls);
  double& radii = balls_[found->second].second;
  radii = std::max(radii, balls);
}

void Wires::add(const RationalCurve& curve, double end_balls) {
  const dvec3 start = curve_point(curve, 0.0), end = curve_point(curve, 1.0);
  add_ball(start, end_balls);
  add_ball(end, end_balls);
  Place from = place(start), to = place(end);
  if (to < from) std::swap(from, to);
  if (!drawn_.insert({from, to, place(curve_point(curve, 0.5))}).second) return;
  const CurveTube tube = curve_tube(curve, radius_);
  for (const TensorNet& net : tube.nets) tubes_.emplace_back(net);
  for (const dvec3& cusp : tube.cusps) add_ball(cusp, 1.0);
}

std::vector<Net> Wires::nets() const {
  std::vector<Net> nets = tubes_;
  for (const auto& [centre, radii] : balls_) {
    for (TensorNet& net : ball(centre, radii * radius_)) nets.emplace_back(std::move(net));
  }
  return nets;
}

}  // namespace rondure
