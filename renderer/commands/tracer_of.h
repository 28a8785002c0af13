// The compiled geometry of a scene, for the sub-commands that ask rays and points of it.
#pragma once

#include <fmt/format.h>

#include <vector>

#include "renderer/api/utf8.h"
#include "renderer/scene/scene.h"

namespace rondure {

// Takes the objects' nets. Throws SceneError at the object whose net cannot be bounded, or at the list when
// the objects together are too small or too large.
inline Tracer tracer_of(Scene& scene) {
  std::vector<TracedSurface> surfaces;
  surfaces.reserve(scene.objects.size());
  for (SceneObject& object : scene.objects) surfaces.push_back(std::move(object.traced));
  try {
    return Tracer(std::move(surfaces));
  } catch (const SurfaceError& error) {
    const SceneObject& object = scene.objects[error.surface];
    scene.fail(object.where, fmt::format("{}: {}", printable(object.name), error.reason));
  } catch (const std::runtime_error& error) {
    scene.fail(scene.objects_where, error.what());
  }
}

}  // namespace rondure
