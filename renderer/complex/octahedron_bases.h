// Bases of functions on the octahedron of renderer/complex/shipped.h (Vidunas 2005, section 3).
#pragma once

#include "renderer/complex/gc_function.h"

namespace rondure {

// Polynomials of degree n, each dual to a coefficient inside a triangle: 4 (n - 1)(n - 2) of them from n = 3
// on, only the constant below. In degree 3 these are "h1" to "h8", scaled as in the paper (Figure 2): the
// coefficient in the middle is 12.
GcBasis octahedron_splines(int n);

// "H0" = 1, "Hx", "Hy", "Hz", "H12", "H34", "HC", "HD" of equations (3.2) and (3.3).
GcBasis octahedron_hierarchy();

// Quotients of quadratic polynomials by u^2 + v^2 + w^2: "A" to "F" of equation (2.7), one for each vertex
// (A, F on the first axis, B, E on the second, C, D on the third), and "vw", "uw", "uv" of equation (2.8).
GcBasis octahedron_rationals();

}  // namespace rondure
