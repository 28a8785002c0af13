// Joins of a surface complex as scenes give them: which edges, and what passes between them.
#pragma once

#include "renderer/api/params.h"
#include "renderer/complex/surface_complex.h"

namespace rondure {

// The keys "sides" and "joins". Joins without "fields" and "theta" take the regular rule of
// renderer/complex/regular_joins.h. Exact while all numbers are: integers, fractions "p/q", and decimals that
// are multiples of 2^-20.
SurfaceComplex read_joined_polygons(Params& object);

}  // namespace rondure
