// Joining two inverse spherical surfaces with one tangent plane along their common side (Casciola and Morigi
// 2004, Proposition 2), and its extension to projection domains that are not coplanar.
#pragma once

#include "renderer/inverse_spherical/iss.h"

namespace rondure {

// alpha, beta, gamma with vertex = alpha T_1 + beta T_2 + gamma T_3.
dvec3 domain_combination(const PlanarIss& s, const dvec3& vertex);

// The vector along `direction` that lies in the plane of the domain of `s` (the paper's choice of the
// modulus). Empty where the direction does not meet that plane on its positive side.
std::optional<dvec3> coplanar_vertex(const PlanarIss& s, const dvec3& direction);

// The side opposite the first corner as a curve of degree n - 1, with coefficients j = 0..n-1 along the
// second corner; empty unless its weights (relative to the largest) fit to 1e-12.
std::optional<std::vector<double>> reduced_side(const PlanarIss& s);

// The patch on (vertex, T_2, T_3) whose first two rows (i = 0 and 1) follow from `s`, so that both meet with
// one tangent plane along their side; the other rows are taken from `weights`. Where the vertex lies in the
// plane of T this is equation 22; elsewhere the side must be of degree n - 1, coefficients w', and
// w~_1jk = alpha w_1jk + beta w_0,j+1,k + gamma w_0,j,k+1 - (n - 1)/n (s - 1) w'_jk with s = alpha + beta +
// gamma. Throws std::invalid_argument unless alpha < 0 (condition C3), the side is as needed and the weights
// come out positive.
PlanarIss joined(const PlanarIss& s, const dvec3& vertex, const std::vector<double>& weights);

}  // namespace rondure
