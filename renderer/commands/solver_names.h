// What finds a scene's hits, in words.
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>

#include "renderer/intersect/solver_name.h"
#include "renderer/scene/scene.h"

namespace rondure {

// Each that some object uses, in the order of the alphabet: "closed form, newton". The scene must still hold
// its nets.
inline std::string solver_names(const Scene& scene) {
  std::set<std::string> names;
  for (const SceneObject& object : scene.objects) names.insert(solver_name(object.traced));
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace rondure
