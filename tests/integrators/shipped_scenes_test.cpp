// Every scene that ships renders: finite, not black, no sample dropped.

#include <cmath>
#include <filesystem>

#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/render/staged_scene.h"

namespace rondure {
namespace {

TEST_CASE("every shipped scene renders", "[integrators]") {
  int scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_folder() + "/scenes")) {
    const std::string path = entry.path().string();
    if (entry.path().extension() != ".json" || path.find("/schema/") != std::string::npos) continue;
    INFO(path);
    ++scenes;
    SceneOverrides overrides;
    overrides.resolution = {16, 16};
    overrides.spp = 4;
    const StagedScene s(read_scene(path, StagedScene::builtins(), overrides));
    const Film film = s.render();
    CHECK(film.rejected == 0);
    int bad = 0, lit = 0, covered = 0;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const FilmSample m = film.mean(x, y);
        for (int c = 0; c < 3; ++c)
          bad += !std::isfinite(m.color[c]) || m.color[c] < 0.0 || !std::isfinite(m.normal[c]);
        lit += m.color.y > 0.0;
        covered += m.alpha > 0.0;
      }
    }
    CHECK(bad == 0);
    CHECK(lit > 16);
    CHECK(covered > 16);
  }
  CHECK(scenes >= 6);
}

}  // namespace
}  // namespace rondure
