#include "renderer/bezier/rational_curve.h"

#include <algorithm>
#include <cmath>

#include "renderer/bezier/curve.h"
#include "renderer/bezier/triangle.h"

namespace rondure {
namespace {

// De Casteljau's algorithm down to the last `rest` coefficients.
RationalCurve reduced(RationalCurve c, double t, std::size_t rest) {
  while (c.size() > rest) {
    detail::casteljau_step(c.data(), static_cast<int>(c.size()) - 1, t);
    c.pop_back();
  }
  return c;
}

RationalCurve restricted(const RationalCurve& c, double from, double to) {
  RationalCurve out(c.size());
  curves_restrict(c.data(), static_cast<int>(c.size()) - 1, 1, from, to, out.data());
  return out;
}

RationalCurve line_on(const TensorNet& net, dvec2 from, dvec2 to) {
  const bool along_u = from.y == to.y;
  RationalCurve across(static_cast<std::size_t>(along_u ? net.n : net.m) + 1);
  RationalCurve line;
  for (int k = 0; k <= (along_u ? net.m : net.n); ++k) {
    for (int l = 0; l < static_cast<int>(across.size()); ++l)
      across[static_cast<std::size_t>(l)] = along_u ? net.at(k, l) : net.at(l, k);
    line.push_back(reduced(across, along_u ? from.y : from.x, 1)[0]);
  }
  return along_u ? restricted(line, from.x, to.x) : restricted(line, from.y, to.y);
}

RationalCurve line_on(const TriangleNet& net, dvec2 from, dvec2 to) {
  const dvec2 corners[3] = {from, to, from};
  TriangleNet cut(net.n);
  triangle_restrict(net.points.data(), net.n, corners, cut.points.data());
  RationalCurve line;
  for (int k = 0; k <= net.n; ++k) line.push_back(cut.at(net.n - k, k));
  return line;
}

bool has_one_sign(const std::vector<double>& weights, int depth) {
  // Where coefficients of both signs stay after so many halvings the weight is a zero but for rounding.
  constexpr int deepest = 40;
  const auto [low, high] = std::minmax_element(weights.begin(), weights.end());
  if (*low > 0.0 || *high < 0.0) return true;
  // The ends are values of the polynomial.
  if (depth == deepest || !(weights.front() * weights.back() > 0.0)) return false;
  std::vector<double> left(weights.size()), right(weights.size());
  curve_halve(weights.data(), static_cast<int>(weights.size()) - 1, 1, left.data(), right.data());
  return has_one_sign(left, depth + 1) && has_one_sign(right, depth + 1);
}

}  // namespace

CurveJet curve_jet(const RationalCurve& curve, double t) {
  const double n = static_cast<double>(curve.size()) - 1.0;
  dvec4 value, first(0.0), second(0.0);
  if (curve.size() > 2) {
    const RationalCurve c = reduced(curve, t, 3);
    second = n * (n - 1.0) * (c[2] - 2.0 * c[1] + c[0]);
    first = n * ((1.0 - t) * (c[1] - c[0]) + t * (c[2] - c[1]));
    value = reduced(c, t, 1)[0];
  } else {
    if (curve.size() == 2) first = curve[1] - curve[0];
    value = reduced(curve, t, 1)[0];
  }
  CurveJet jet;
  jet.point = dvec3(value) / value.w;
  jet.first = (dvec3(first) - first.w * jet.point) / value.w;
  jet.second = (dvec3(second) - second.w * jet.point - 2.0 * first.w * jet.first) / value.w;
  return jet;
}

dvec3 curve_point(const RationalCurve& curve, double t) {
  const dvec4 value = reduced(curve, t, 1)[0];
  return dvec3(value) / value.w;
}

bool is_finite(const RationalCurve& curve) {
  std::vector<double> weights;
  for (const dvec4& p : curve) {
    if (!std::isfinite(p.x + p.y + p.z + p.w)) return false;
    weights.push_back(p.w);
  }
  return has_one_sign(weights, 0);
}

RationalCurve curve_on(const Net& net, dvec2 from, dvec2 to) {
  return std::visit([&](const auto& n) { return line_on(n, from, to); }, net);
}

}  // namespace rondure
