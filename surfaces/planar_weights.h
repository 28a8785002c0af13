// Parameters that the families of stereographic images have in common.
#pragma once

#include "renderer/api/surface.h"
#include "renderer/projective/quad_patch.h"

namespace rondure {

inline CornerWeights read_corner_weights(Params& params) {
  const bool unit = params.choice("corner_weights", {"unit", "matched"}, "matched") == "unit";
  return unit ? CornerWeights::unit : CornerWeights::matched;
}

inline ParameterDoc corner_weights_doc() {
  return {"corner_weights", "\"unit\" or \"matched\"", "\"matched\"",
          "weights of the planar patches' corners: 1, as the paper has them, so that neighbours share their "
          "edges but not always the parameters along them; or 1 - z, with which they agree point by point"};
}

// Beyond these nearly all of a patch is squeezed into a few of its parameters, and its weights lie so far
// apart that hits lose digits.
inline constexpr Range middle_weight_range{1e-3, 100.0, false, false};

inline double read_middle_weight(Params& params) {
  return params.number("middle_weight", 1.0, middle_weight_range);
}

inline ParameterDoc middle_weight_doc(const char* default_value) {
  return {
      "middle_weight", "number in [0.001, 100]", default_value,
      "weight of the planar patches' middle control point, in units of the mean of their corners' weights; "
      "moves parameters, not the surface"};
}

}  // namespace rondure
