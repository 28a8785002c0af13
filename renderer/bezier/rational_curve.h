// Rational Bezier curves in space, given by homogeneous control points (w x, w y, w z, w).
#pragma once

#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

using RationalCurve = std::vector<dvec4>;

// The point and its derivatives with respect to t.
struct CurveJet {
  dvec3 point, first, second;
};
CurveJet curve_jet(const RationalCurve& curve, double t);

dvec3 curve_point(const RationalCurve& curve, double t);

// Whether the weight has no zero in [0, 1], and all control points are finite numbers.
bool is_finite(const RationalCurve& curve);

// The curve that a net has over the segment from one parameter pair to another. On a tensor-product net the
// segment must run along u or v.
RationalCurve curve_on(const Net& net, dvec2 from, dvec2 to);

}  // namespace rondure
