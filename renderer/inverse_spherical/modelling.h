// Degree elevation, subdivision and restriction of inverse spherical surfaces with planar projection domains
// (Casciola and Morigi 2004, section 5). None moves a point of the surface.
#pragma once

#include "renderer/inverse_spherical/iss.h"

namespace rondure {

// The same surface with degree s.n + times, at most max_degree.
PlanarIss elevated(const PlanarIss& s, int times);
// Any projection domain: u and the weights are elevated, the c follow.
TriangleNet elevated(const TriangleNet& net, int times);

// The part over the triangle with these barycentric corners (u, v); they become the corners in this order.
PlanarIss restricted(const PlanarIss& s, const std::array<dvec2, 3>& corners);

// Three parts that meet at tau = (u, v, 1 - u - v), inside the triangle: each has that point for the corner
// of its number and keeps the two others.
std::array<PlanarIss, 3> split_at(const PlanarIss& s, double u, double v);

// Four parts: at the three corners, and the one between, with the halves of the plane triangle's sides.
std::array<PlanarIss, 4> quartered(const PlanarIss& s);

// An inverse circular curve: a rational curve over the great-circle arc between two directions. Coefficient k
// belongs to u_k = ((n - k) from + k to) / n.
struct InverseCircularCurve {
  int n = 0;
  dvec3 from{0.0}, to{0.0};
  std::vector<double> weights;

  dvec3 point(double t) const;
  std::vector<double> coefficients() const;   // c_k = w_k / |u_k|
  std::vector<dvec4> control_points() const;  // (u_k, w_k): the rational Bezier curve that it is
};

// The surface along the great-circle arc between the directions of two points of its domain, a chord there.
InverseCircularCurve along_arc(const PlanarIss& s, dvec2 from, dvec2 to);

// The surface over its part of the shorter great-circle arc between two directions, which must not be
// parallel or opposite. Empty where the arc passes by the spherical triangle or only touches it. An arc along
// a side is the side's, to some units of rounding.
std::optional<InverseCircularCurve> along_arc(const PlanarIss& s, const dvec3& from, const dvec3& to);

}  // namespace rondure
