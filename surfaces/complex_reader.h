// Surface complexes as scenes give them.
#pragma once

#include <functional>
#include <vector>

#include "renderer/api/surface.h"
#include "renderer/complex/fit.h"

namespace rondure {

struct ComplexChoice {
  SurfaceComplex complex;
  std::vector<std::vector<int>> vertices;  // number of the vertex at [polygon][corner]
  int vertex_count = 0;
  // The shape that a built-in complex has without control points, from the degree; empty for others.
  std::function<CoefficientTargets(int)> shape;
};

// The key "complex". A complex that breaks Definition 5.1 is an error that says where.
ComplexChoice read_complex(Params& params);

ParameterDoc complex_doc();

}  // namespace rondure
