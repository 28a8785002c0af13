#include "renderer/scene/scene_reader.h"
#include "tests/fuzz/exercise.h"
#include "tests/fuzz/targets.h"

namespace rondure {

void fuzz_scene(std::string_view bytes) {
  accepted([&] {
    Scene scene = read_scene_text("scene.json", std::string(bytes), builtins(), {});
    exercise(scene);
  });
}

}  // namespace rondure
