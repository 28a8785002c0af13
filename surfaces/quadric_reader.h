// Quadrics as scenes write them.
#pragma once

#include "renderer/api/surface.h"
#include "renderer/projective/quadric.h"

namespace rondure {

// From "quadric" and "semi_axes", or "matrix".
Quadric read_quadric(Params& params);

ParameterDoc quadric_doc();
ParameterDoc semi_axes_doc();
ParameterDoc matrix_doc();

}  // namespace rondure
