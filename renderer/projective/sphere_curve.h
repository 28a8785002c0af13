// Rational curves on the unit sphere: images of Bezier curves of projective 3-space under delta (Dietz,
// Hoschek, Juettler 1993, sections 3.4, 3.6 and 4).
#pragma once

#include <vector>

#include "renderer/projective/spinor.h"

namespace rondure {

// Control points (x, y, z, w) of the image of the Bezier curve with these control points: twice the degree.
std::vector<lvec4> curve_image(const std::vector<lvec4>& preimage);

// The circle through three points of the sphere as the image of a segment, from p past r to q (lemma 3.7).
std::vector<lvec4> circle_through(const lvec3& p, const lvec3& r, const lvec3& q);

struct Interpolation {
  std::vector<lvec4> preimage;  // n + 1 control points over [0, 1]
  // The least singular value of the linear system over the greatest: near 0 more than one curve fits, but for
  // rounding.
  long double condition;
  // Points at whose parameters the preimage vanishes: the curve does not pass through them ("inaccessible").
  std::vector<std::size_t> inaccessible;
};

// The curve of degree 2n that passes through 2n + 1 points of the sphere at these distinct parameters
// (theorem 3.13): a homogeneous linear problem, complex here. Unique but for inaccessible points.
Interpolation interpolate(const std::vector<lvec3>& points, const std::vector<long double>& parameters);

struct CircularSpline {
  std::vector<lvec4> preimage;  // of a polygon: arc k is the image of the segment from k to k + 1
  // Lengths of parameter intervals with which the curve is C1 and not only tangent-continuous.
  std::vector<long double> intervals;
};

// Arcs through the points, each tangent to the one before it; the first passes through `on_first` (equation
// 36, with the sign that excludes cusps).
CircularSpline circular_spline(const std::vector<lvec3>& points, const lvec3& on_first);

}  // namespace rondure
