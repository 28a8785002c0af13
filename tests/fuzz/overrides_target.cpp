#include <sstream>

#include "renderer/scene/scene_reader.h"
#include "tests/fuzz/exercise.h"
#include "tests/fuzz/targets.h"

namespace rondure {

void fuzz_overrides(std::string_view bytes) {
  SceneOverrides overrides;
  std::istringstream lines{std::string(bytes)};
  for (std::string line; std::getline(lines, line);) overrides.set.push_back(line);
  accepted([&] {
    Scene scene = read_scene_text("scene.json",
                                  R"({ "materials": { "m": { "type": "conductor" } },
                                       "lights": [ { "type": "point", "position": [1, 2, 3] } ],
                                       "objects": [ { "type": "sphere_octant", "material": "m" } ] })",
                                  builtins(), overrides);
    exercise(scene);
  });
}

}  // namespace rondure
