// Closed bodies that lose no light, in light that is the same everywhere, cannot be seen.

#include <fmt/format.h>

#include <cmath>

#include "renderer/film/image.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/render/staged_scene.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

const char* bodies[] = {R"("type": "sphere")", R"("type": "sphere_tiling", "topology": "cube")",
                        R"("type": "sphere_tiling", "topology": "hemispheres")",
                        R"("type": "sphere_octant")"};

std::string furnace(const std::string& body, const std::string& material, const std::string& light) {
  return fmt::format(R"({{ "camera": {{ "type": "perspective", "origin": [1, -4, 1.5], "fov": 32 }},
    "film": {{ "resolution": [40, 40] }}, 
    "integrator": {{ "type": "path", "max_depth": 200, "min_depth": 200 }},
    "materials": {{ "m": {} }}, "lights": [ {} ], "objects": [ {{ {}, "material": "m" }} ] }})",
                     material, light, body);
}

void check_every_pixel(const StagedScene& s) {
  const Film film = s.render(16);
  WorstCase worst;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const auto describe = [&] { return fmt::format("pixel {}, {}", x, y); };
      // Each sample is 1 but for the rounding of some factors that cancel.
      for (int c = 0; c < 3; ++c) worst.add(std::abs(film.mean(x, y).color[c] - 1.0), 1e-13, describe);
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(film.rejected == 0);
}

TEST_CASE("white bodies vanish in a constant light, pixel by pixel", "[integrators]") {
  for (const char* body : bodies) {
    INFO(body);
    check_every_pixel(
        StagedScene(furnace(body, R"({ "type": "diffuse", "albedo": 1 })", R"({ "type": "constant" })")));
  }
}

TEST_CASE("clear glass vanishes in a constant light, pixel by pixel", "[integrators]") {
  for (const char* body : bodies) {
    INFO(body);
    check_every_pixel(
        StagedScene(furnace(body, R"({ "type": "dielectric", "ior": 1.5 })", R"({ "type": "constant" })")));
  }
}

TEST_CASE("white bodies vanish in an image of constant light, to the measured error", "[integrators]") {
  // Now light samples and scattering samples share the work, and each sample scatters about 1.
  const std::string file = scratch_folder() + "/white.png";
  write_png(file, 4, 2, std::vector<unsigned char>(24, 255));
  const std::string light = fmt::format(R"({{ "type": "environment", "file": "{}" }})", file);
  for (const char* body : bodies) {
    const StagedScene s(furnace(body, R"({ "type": "diffuse", "albedo": 1 })", light));
    const Estimate e = picture_mean(s.render(64));
    INFO(body << ": " << e.mean << " +- " << e.error);
    CHECK(std::abs(e.mean - 1.0) < 4.0 * e.error);
    CHECK(e.error < 0.002);
    CHECK(e.error > 0.0);
  }
}

}  // namespace
}  // namespace rondure
