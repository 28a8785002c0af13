// Control points and knots of splines as scenes write them.
#pragma once

#include <vector>

#include "renderer/api/params.h"
#include "renderer/projective/bspline.h"

namespace rondure {

// [p0, p1, p2, p3]
lvec4 read_preimage_point(const Params& params, const Value& value);

// An array of finite numbers.
std::vector<long double> read_knots(const Params& params, const Value& list);

// Equidistant, the curve starting at the first and ending at the last point.
std::vector<long double> clamped_knots(int degree, std::size_t points);

}  // namespace rondure
