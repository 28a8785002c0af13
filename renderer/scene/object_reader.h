// One entry of a scene's "objects": the family builds the surface, this places it in the world.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/api/registry.h"
#include "renderer/scene/scene.h"

namespace rondure {

// p becomes transform(center + radius p).
struct Placement {
  dvec3 center{0.0};
  double radius = 1.0;
  dmat4 transform{1.0};
};

// Nets and ellipsoid take the linear part; the rest goes to the surface's origin, so that a translation
// leaves every control point as it is. A projective transform acts on the homogeneous nets. Throws
// std::invalid_argument for a projective transform of an analytic surface.
void place(Surface& surface, const Placement& placement);

// Materials that are not an index: of an object that names none, and of wires that are to be seen on the
// surface before them.
inline constexpr int default_material = -1;
inline constexpr int contrast_material = -2;

// The estimator that a scene names there, or the limit.
NormalEstimator read_estimator(Params& params, std::string_view key);

// Reads and finishes the object: what "show" names in one material, and after it the wires in theirs, if
// there are both. `materials` maps names to indices.
std::vector<SceneObject> read_object(Params& params, const Registry& registry,
                                     const std::map<std::string, int>& materials);

}  // namespace rondure
