// Spherical barycentric coordinates and the spherical Bernstein basis (Casciola and Morigi 2004, section 4).
#pragma once

#include "renderer/inverse_spherical/iss.h"

namespace rondure {

// det(a, b, c): positive when the corners turn anticlockwise as seen from outside.
double orientation(const dvec3& a, const dvec3& b, const dvec3& c);

// beta with v = sum of beta_i v_i, for unit vectors: ratios of the sines of the angles between v, v_i and the
// plane of the two other corners (equation 12). They sum to more than 1 inside the triangle.
dvec3 spherical_barycentric(const std::array<dvec3, 3>& corners, const dvec3& v);

// tau, of sum 1, with u(tau) along v, on the plane of three corners that need not be unit (equation 21). v is
// of any length. Zero where v is parallel to that plane.
dvec3 domain_coordinates(const std::array<dvec3, 3>& corners, const dvec3& v);

// The spherical basis functions at tau = (u, v, 1 - u - v), in triangle_index order, by their explicit sum
// over all paths of the algorithm (Theorem 3, equation 28). The number of paths is 3^n: for small n.
std::vector<double> spherical_basis_by_paths(const Iss& s, double u, double v);

// The same from the ordinary Bernstein basis (Theorem 4, equation 29).
std::vector<double> spherical_basis(const Iss& s, double u, double v);

}  // namespace rondure
