// rondure export --form preimage: patches of spheres as images of nets in projective 3-space.
#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace rondure {

// The members of an object of type projected_net with this one's patches, after its "name": "type", "center",
// "radius" and the nets (Dietz, Hoschek, Juettler 1993, theorem 2.2). Throws SceneError at the object where
// one of its patches is no such image of half its degree, and where the preimage has base points.
std::string preimage_members(const Scene& scene, const SceneObject& object);

}  // namespace rondure
