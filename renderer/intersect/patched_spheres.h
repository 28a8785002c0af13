// The spheres and ellipsoids on which a scene's patches lie, and what those share whose patches are alike.
#pragma once

#include <span>
#include <vector>

#include "renderer/intersect/sphere_solver.h"

namespace rondure {

// Of one surface.
struct SurfaceSpheres {
  std::span<const PatchedSphere> spheres;
  std::vector<bool> rest;  // rest[k]: patch k is on none of them
};

struct SceneSpheres {
  std::vector<PatchedSphere> spheres;  // side by side, as there may be many
  std::vector<SurfaceSpheres> surfaces;
};

// Of each of these surfaces' patches; of nullptr nothing. What is found of one does not depend on how many
// threads look. Grids of cells are smaller where there are many that are not alike.
SceneSpheres patched_spheres(const std::vector<const std::vector<Net>*>& surfaces);

}  // namespace rondure
