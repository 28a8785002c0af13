// What is allowed in a scene and seldom meant.
#pragma once

#include <fmt/format.h>

#include <string>
#include <variant>
#include <vector>

#include "renderer/api/utf8.h"
#include "renderer/scene/coincident_patches.h"
#include "renderer/scene/scene.h"

namespace rondure {

// One line each. Ask before the objects' nets go to the tracer.
inline std::vector<std::string> scene_warnings(const Scene& scene) {
  std::vector<std::string> warnings;
  for (const SceneObject& object : scene.objects) {
    const Surface& surface = object.traced.surface;
    for (const std::string& text : surface.warnings)
      warnings.push_back(fmt::format("{}:{}:{}: warning: {}: {}", scene.path, object.where.line,
                                     object.where.column, printable(object.name), printable(text, 500)));
    if (const auto pair = coincident_patches(surface.patches))
      warnings.push_back(fmt::format(
          "{}:{}:{}: warning: {}: patches {} and {} lie on each other; of one object's walls in one place "
          "none comes first: bodies that share a wall want an object each",
          scene.path, object.where.line, object.where.column, printable(object.name), pair->first,
          pair->second));
    const Material& material = scene.materials[static_cast<std::size_t>(object.material)];
    if (surface.closed || surface.ellipsoid || !std::holds_alternative<Dielectric>(material.scattering))
      continue;
    warnings.push_back(fmt::format(
        "{}:{}:{}: warning: {}: a dielectric on a surface that is not closed; what lies behind it is "
        "inside and outside at once",
        scene.path, object.where.line, object.where.column, printable(object.name)));
  }
  return warnings;
}

}  // namespace rondure
