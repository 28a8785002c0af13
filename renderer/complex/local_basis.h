// Bases of spline spaces whose functions live on few polygons each.
#pragma once

#include "renderer/complex/spline_space.h"

namespace rondure {

// The polygons of regions on which functions may live, stage by stage: every polygon; the two at every edge;
// those around every vertex; around both ends of every edge; around all corners of every polygon; then ever
// wider rings around one, the last of them all that hangs together.
std::vector<std::vector<std::vector<int>>> support_stages(const SurfaceComplex& complex);

// The space of polynomials of degree n (spline_space) on an exact complex, exactly, with another basis: each
// function lives on a region of the first stage at which functions of such regions span it, so that none
// could be made of functions with regions of earlier stages. Function k is 1 at its unknown free[k], but need
// not vanish at those of the others; no two have the same.
SplineSpace local_spline_space(const SurfaceComplex& complex, int n);

// The same space on any complex, to rounding, with a basis that is local as far as it can be and well
// conditioned: of each region's functions, found as above and orthonormal, those directions are taken that
// lie outside the span of what was found before by 1/10 of their length or more. What regions of up to 320
// coefficients do not hold, functions orthogonal to all of these make up for; they live everywhere. Function
// k is 1 at its unknown free[k]. `gap` is the least fall of pivots behind any of the ranks. Throws
// std::runtime_error where the rank of all conditions falls by less than 10^3.
SplineSpace rounded_local_space(const SurfaceComplex& complex, int n);

}  // namespace rondure
