// The options that every sub-command with a scene shares: the file, --set and --solver.
#pragma once

#include <string>

#include "renderer/scene/overrides.h"

namespace CLI {
class App;
}

namespace rondure {

struct SceneOptions {
  std::string path;
  SceneOverrides overrides;
};

// `options` must live as long as `command`.
void add_scene_options(CLI::App& command, SceneOptions& options);
// And those that only rendering needs: --spp, --seed, --resolution WxH, --integrator.
void add_sampling_options(CLI::App& command, SceneOptions& options);

}  // namespace rondure
