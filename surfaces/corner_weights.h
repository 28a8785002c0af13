// The parameter "corner_weights", which the families of stereographic images have in common.
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

}  // namespace rondure
