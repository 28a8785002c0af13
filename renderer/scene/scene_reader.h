// From a scene file to a Scene: defaults filled in, everything checked, surfaces placed in the world.
#pragma once

#include <string>

#include "renderer/api/registry.h"
#include "renderer/scene/overrides.h"
#include "renderer/scene/scene.h"

namespace rondure {

// Throws SceneError for anything wrong with the file or with what it says.
Scene read_scene(const std::string& path, const Registry& registry, const SceneOverrides& overrides = {});

// The same for text at hand; `name` stands for the path in messages, and files are looked for beside it.
Scene read_scene_text(const std::string& name, std::string text, const Registry& registry,
                      const SceneOverrides& overrides = {});

}  // namespace rondure
