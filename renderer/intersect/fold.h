// Roots near a fold: where the two projected polynomials' gradients are parallel, or nearly.
//
// Turn the pair so that the first polynomial carries the gradient and the second has (nearly) none. Where the
// first is zero on a graph y(x), the second becomes a function h(x) of one variable. If h is convex (or
// concave) over the whole cell, then it has two roots at most, and they lie on either side of its extremum:
// there is nothing more to search. This holds for tangential rays, h touching zero, and at corners where the
// tangents are parallel.
#pragma once

#include <cmath>

#include "renderer/intersect/graph.h"

namespace rondure {

struct FoldResult {
  enum class Kind { undecided, none, tangent, pair } kind = Kind::undecided;
  bool narrow = false;     // a pair that is within rounding of being tangent
  dvec2 at[2];             // cell parameters; one for `tangent`
  double tolerance = 0.0;  // how far rounding may move each, in cell parameters
};

// `f`: the turned pair on the cell, evaluation error below `error`. `curvature`: range of h'' over the cell,
// of one sign.
template <class Shape>
FoldResult solve_fold(const Shape& shape, const dvec2* f, bool swapped, Interval curvature, double error) {
  constexpr double reach = 1.5;  // how far outside the cell the extremum may lie for the model to be trusted
  constexpr double outskirts = 0.25;
  const Axes axes{swapped};
  const auto beyond = [](double x) { return std::fabs(x - 0.5); };
  const double sign = curvature.low > 0.0 ? 1.0 : -1.0;
  const dvec2 c = Shape::center();
  double x = swapped ? c.y : c.x, y = swapped ? c.x : c.y;

  Along at = along_graph(shape, f, axes, x, y);
  for (int k = 0; k < 24; ++k) {
    if (!(at.ddh * sign > 0.0)) return {};
    const double step = -at.dh / at.ddh;
    x += step;
    y += at.dy * step;
    if (!(beyond(x) < reach) || !(beyond(y) < reach)) return {};
    at = along_graph(shape, f, axes, x, y);
    // The extremum enters the roots through h'^2 only: half of the digits suffice.
    if (std::fabs(step) < 1e-9) break;
  }
  if (!(at.ddh * sign > 0.0)) return {};

  FoldResult result;
  const double depth = -sign * (at.h - 0.5 * at.dh * at.dh / at.ddh), bend = std::fabs(at.ddh);
  result.tolerance = std::sqrt(2.0 * error / bend);
  if (depth < -error) {
    result.kind = FoldResult::Kind::none;
    return result;
  }
  if (depth <= 0.1 * error) {
    result.kind = FoldResult::Kind::tangent;
    result.at[0] = axes.to_cell(x, y);
    return result;
  }
  result.kind = FoldResult::Kind::pair;
  result.narrow = depth <= error;
  const double spread = std::sqrt(2.0 * depth / curvature.mignitude());  // at or beyond both roots
  result.tolerance = std::min(result.tolerance, 2.0 * error / (bend * spread));
  for (int side = 0; side < 2; ++side) {
    const double turn = side == 0 ? -1.0 : 1.0;
    // From beyond the root, Newton's method on a convex function closes in without crossing it. But not from
    // far beyond the cell, where the function need not be convex: what root is out there is no matter here.
    const double limit = side == 0 ? -outskirts : 1.0 + outskirts;
    double rx = x + turn * spread;
    if (turn * (x - limit) >= 0.0) {
      result.at[side] = axes.to_cell(rx, y + at.dy * (rx - x));
      continue;
    }
    rx = turn * std::min(turn * rx, turn * limit);
    double ry = y + at.dy * (rx - x);
    for (int k = 0; k < 40; ++k) {
      const Along r = along_graph(shape, f, axes, rx, ry);
      if (!(std::fabs(r.dh) > 0.0)) break;
      const double step = -r.h / r.dh;
      rx += step;
      ry += r.dy * step;
      if (std::fabs(step) < 1e-15 || !std::isfinite(step)) break;
    }
    // The other's root, or none.
    if (!result.narrow && !(turn * (rx - x) >= 0.0)) return {};
    result.at[side] = axes.to_cell(rx, ry);
  }
  return result;
}

}  // namespace rondure
