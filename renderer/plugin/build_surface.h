// The only way from a family's name and parameters to its patches.
#pragma once

#include "renderer/api/surface.h"

namespace rondure {

// Calls `family.build` and holds what comes back to what solvers, wires and exports rely on: patches or an
// ellipsoid, degrees from 1 to max_degree with as many control points, everything finite. Throws SceneError
// at the object for a family that breaks this or throws anything but a SceneError (or is out of memory).
Surface build_surface(const SurfaceFamily& family, Params& params);

}  // namespace rondure
