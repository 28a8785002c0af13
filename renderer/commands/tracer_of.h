// The compiled geometry of a scene, for the sub-commands that ask rays and points of it.
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace rondure {

// Takes the objects' nets. Throws std::runtime_error that names the scene and the object whose net cannot be
// bounded.
inline Tracer tracer_of(Scene& scene) {
  std::vector<TracedSurface> surfaces;
  surfaces.reserve(scene.objects.size());
  for (SceneObject& object : scene.objects) surfaces.push_back(std::move(object.traced));
  try {
    return Tracer(std::move(surfaces));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(scene.path + ": " + error.what());
  }
}

}  // namespace rondure
