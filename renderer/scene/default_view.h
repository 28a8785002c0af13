// The camera of a scene that has none.
#pragma once

#include <vector>

#include "renderer/camera/camera.h"
#include "renderer/scene/scene.h"

namespace rondure {

// A three-quarter view from above, 35 degrees high, that just holds the bounding sphere of the control
// points' box; `aspect` is width / height. Points at infinity and of negative weight are left out.
Camera view_of(const std::vector<SceneObject>& objects, double aspect);

}  // namespace rondure
