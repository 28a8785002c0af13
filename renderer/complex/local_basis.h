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

}  // namespace rondure
