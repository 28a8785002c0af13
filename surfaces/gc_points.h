// Control points of geometrically continuous surfaces as scenes give them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/api/surface.h"
#include "renderer/complex/complex_surface.h"

namespace rondure {

struct BlendPoints {
  std::vector<BlendPoint> points;  // of the functions, in their order
  bool weighted = false;           // some point was given with a weight
};

// The key "control_points": an object from names of functions to [x, y, z] or [w x, w y, w z, w] with w > 0,
// where "rest" stands for the names that are not there. Otherwise those keep their default; it is an error
// when they have none.
BlendPoints read_blend_points(Params& params, const std::vector<std::string>& names,
                              const std::vector<std::optional<BlendPoint>>& defaults);

// The patches that the points make, refused where their weight vanishes.
Surface blended_surface(Params& params, const SurfaceComplex& complex, const GcBasis& basis,
                        const BlendPoints& points);

ParameterDoc control_points_doc(const std::string& default_value, const std::string& meaning);

}  // namespace rondure
