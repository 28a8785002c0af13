// What a render's saved sums must agree on before another run adds to them.
#pragma once

#include <string>
#include <vector>

#include "renderer/film/film.h"
#include "renderer/scene/scene.h"

namespace rondure {

// Version, scene hash, seed, size, window, and a hash of what the scene's text only points to: control nets
// and environment images, and of the files of all plugins. The scene must still hold its nets. Throws
// SceneError for an image, std::runtime_error for a plugin, that cannot be read.
std::string resume_key(const Scene& scene, const Film& film, const std::vector<std::string>& plugins = {});

}  // namespace rondure
