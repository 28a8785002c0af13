// Round tubes along lines, circles and other rational curves, to draw curves and control polygons with. Exact
// where the curve is straight or circular.
#pragma once

#include <vector>

#include "renderer/bezier/rational_curve.h"

namespace rondure {

// The cylinder of this radius about the segment, open at its ends: three patches of degree (2, 1), normals
// outward. None where the ends coincide.
std::vector<TensorNet> straight_tube(const dvec3& from, const dvec3& to, double radius);

// The points centre + cos(s) a + sin(s) b, s from 0 to `angle` in (0, 2 pi]; a and b of one length and at
// right angles.
struct CircleArc {
  dvec3 centre, a, b;
  double angle;
};

// The torus of this radius about the arc, open at its ends: three patches of degree (2, 2) for each quarter
// of a circle or part of it, normals outward.
std::vector<TensorNet> circle_tube(const CircleArc& arc, double radius);

struct CurveTube {
  std::vector<TensorNet> nets;  // open at the curve's ends, normals outward
  std::vector<dvec3> cusps;     // where the curve has no tangent: a ball belongs there
  dvec3 start{0.0}, end{0.0};   // unit tangents at the ends; zero at a cusp
};

// The greatest distance of a tube's points from the true offset, relative to its radius.
inline constexpr double tube_accuracy = 1e-3;

// The tube of this radius about a curve whose weights have no zero in [0, 1]: cylinders or tori where the
// curve is a line or a circular arc, else patches of degree (2, 3) with smooth joints. Where the curve turns
// more sharply than the tube is thick the tube penetrates itself. Nothing for a curve that is one point.
// Throws std::invalid_argument where the radius is below 1e-9 of the largest coordinate, so that rounding
// would show, or the tube would need more than 50000 sections.
CurveTube curve_tube(const RationalCurve& curve, double radius);

}  // namespace rondure
