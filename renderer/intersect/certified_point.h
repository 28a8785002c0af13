// How far a patch's point, as evaluated in double, is from its exact point at parameters nearby.
#pragma once

#include <cmath>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/certified_net.h"

namespace rondure {

// Both parameters of the exact point are within `reach` of (u, v), which is in the patch. With X = (w S) and
// d the sum of degrees, X(q) is X(p) and the first derivatives' part, within reach^2 / 2 times the second
// ones, which the control points bound by 4 d^2 |X|. S(q) - S(p) = (X(q) - X(p) - S(p) (w(q) - w(p))) / w(q).
// Infinite where the weight may vanish on the way.
inline double point_bound(const Net& net, dvec2 at, double reach) {
  const auto length = [](const dvec3& x) { return std::hypot(x.x, x.y, x.z); };
  double size = 0.0, weight = 0.0;
  for (const dvec4& p : points_of(net))
    size = std::max(size, length(dvec3(p))), weight = std::max(weight, std::fabs(p.w));
  const NetShape shape = shape_of(net);
  const double d = shape.m + shape.n;
  // Of a sum over the basis, whose every function is a product of 2 d factors at most; twice that.
  const double rounding = 4.0 * (2.0 * d + 4.0) * roundoff<double>;
  const FirstOrder<dvec4> x = net_first(net, at.x, at.y);
  const dvec3 s = dvec3(x.value) / x.value.w;
  const double both = size + length(s) * weight;
  // Derivatives are d times differences of such sums.
  const double slope =
      length(dvec3(x.du) - x.du.w * s) + length(dvec3(x.dv) - x.dv.w * s) + 4.0 * d * rounding * both;
  const double bend = 2.0 * reach * reach * d * d;
  const double least_w = x.value.w - reach * (std::fabs(x.du.w) + std::fabs(x.dv.w)) -
                         (bend + rounding + 4.0 * reach * d * rounding) * weight;
  if (!(least_w > 0.0)) return std::numeric_limits<double>::infinity();
  return (reach * slope + (bend + rounding) * both) / least_w * (1.0 + 0x1p-40);
}

}  // namespace rondure
