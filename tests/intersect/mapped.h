// A surface under an affine map.
#pragma once

#include "renderer/api/patch.h"
#include "renderer/bezier/transform.h"

namespace rondure {

// Its patches' nets, rounded; joins and origin stay.
inline Surface mapped(Surface surface, const dmat4& map) {
  for (Net& net : surface.patches)
    for (dvec4& p : points_of(net)) p = map * p;
  return surface;
}

}  // namespace rondure
