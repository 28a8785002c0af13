// Neighbours' boundary curves made equal to the last bit.
//
// Each patch is rounded by itself, and where the functions are irrational each of its coefficients is a sum
// with a rounding of its own. The gap that this leaves at an edge is a few roundoffs wide; a ray that grazes
// both patches there would pass between them.
#pragma once

#include <vector>

#include "renderer/api/patch.h"
#include "renderer/complex/surface_complex.h"

namespace rondure {

// nets[k]: of polygon k, in its own parameters. Control points of glued edges that differ by rounding only
// (2^-44 of the largest coordinate) become one, that of the first net; the corners all round a vertex too.
// Edges of different degrees are left as they are, and so are those whose points differ by more.
void weld(const SurfaceComplex& complex, std::vector<Net>& nets);

}  // namespace rondure
