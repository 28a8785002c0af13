// Inverse spherical surfaces (Casciola and Morigi 2004): rational triangular patches whose homogeneous
// control vectors, seen from the origin, partition a spherical triangle, so that the surface is r(v) v for
// directions v.
//
// Coefficients are ordered by triangle_index(n, i, j); i belongs to the first corner (u = 1), j to the
// second, k = n - i - j to the third. A patch whose corners turn anticlockwise as seen from outside has an
// outward normal; the functions here keep whatever order they are given.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// The general form (section 3): u_ijk in space and c_ijk > 0. The control points are u / (c |u|).
struct Iss {
  int n = 0;
  std::vector<dvec3> u;
  std::vector<double> c;
};

// The form with a planar projection domain (section 5): u_ijk = (i T_1 + j T_2 + k T_3) / n, equation 19. The
// weights are w_ijk = c_ijk |u_ijk| > 0.
struct PlanarIss {
  int n = 0;
  std::array<dvec3, 3> corners{};  // T_1 = u_n00, T_2 = u_0n0, T_3 = u_00n: a direction times its modulus
  std::vector<double> weights;

  dvec3 u(int i, int j) const;
};

PlanarIss planar_iss(int n, const std::array<dvec3, 3>& corners, const std::vector<double>& c);
Iss general_form(const PlanarIss& s);

// The rational Bezier patch that an inverse spherical surface is: weights c |u|, section 3.
TriangleNet net_of(const Iss& s);
TriangleNet net_of(const PlanarIss& s);

// The converse. Throws std::invalid_argument for a weight that is not positive or a control point at the
// origin; whether the directions form a partition is for partition_fault (partition.h) to say.
Iss iss_of(const TriangleNet& net);

// The same surface with its corners renamed: the first becomes the one numbered `first`, the others follow.
PlanarIss rotated(const PlanarIss& s, int first);

}  // namespace rondure
