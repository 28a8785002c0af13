// Points of inverse spherical surfaces: the paper's three algorithms and its explicit form (Casciola and
// Morigi 2004), which agree to rounding, and the surface as a function of direction. (u, v, 1 - u - v) are
// barycentric.
#pragma once

#include "renderer/inverse_spherical/iss.h"

namespace rondure {

// Algorithm 1: de Casteljau on control points and weights of any rational triangular patch.
dvec3 point_by_casteljau(const TriangleNet& net, double u, double v);

// Algorithm 2: the spherical de Casteljau algorithm, on u and c. The point is v / p.
struct SphericalPoint {
  dvec3 direction{0.0};  // v(tau), unit
  double p = 0.0;        // reciprocal of the radius
  dvec3 point() const { return direction / p; }
};
SphericalPoint point_by_spherical_casteljau(const Iss& s, double u, double v);

// Algorithm 3: de Casteljau on the weights alone, for planar projection domains.
dvec3 point_by_weights(const PlanarIss& s, double u, double v);

// Equation 7: sums over the Bernstein basis.
dvec3 point_by_sums(const Iss& s, double u, double v);

// The radius in direction v, of any length, by equations 20 and 21: the surface as a single-valued function.
// Empty where v lies outside the spherical triangle; its sides belong to it, to a few units of rounding.
std::optional<double> radius_towards(const PlanarIss& s, const dvec3& v);

}  // namespace rondure
