// Surfaces where a test wants them.
#pragma once

#include "renderer/api/surface.h"

namespace rondure {

// The unit-size surface, scaled and moved.
inline Surface placed(Surface surface, double radius, const dvec3& center) {
  for (Net& net : surface.patches)
    for (dvec4& p : points_of(net)) p = dvec4(radius * dvec3(p), p.w);
  if (surface.ellipsoid) *surface.ellipsoid *= radius;
  surface.origin = center;
  return surface;
}

}  // namespace rondure
