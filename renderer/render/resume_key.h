// What a render's saved sums must agree on before another run adds to them.
#pragma once

#include <string>

#include "renderer/film/film.h"
#include "renderer/scene/scene.h"

namespace rondure {

// Version, scene hash, seed, size, window, and a hash of what the scene's text only points to: control nets
// and environment images. The scene must still hold its nets. Throws SceneError for an image that
// cannot be read.
std::string resume_key(const Scene& scene, const Film& film);

}  // namespace rondure
