// The layer of certificates: what the certifier says, in floats that keep its bounds, and no pixel of a
// shipped scene without a proof.

#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "renderer/intersect/certificate.h"
#include "renderer/layers/certificate.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/process.h"
#include "tests/render/staged_scene.h"
#include "tests/soak.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

Ray ray_of(const StagedScene& s, int x, int y) {
  const FilmSettings& film = s.scene.film;
  const double aspect = static_cast<double>(film.width) / film.height;
  return camera_ray(s.scene.camera, aspect, {(x + 0.5) / film.width, (y + 0.5) / film.height}, {0.5, 0.5});
}

TEST_CASE("the layer of certificates tells what the certifier does", "[layers][certificate]") {
  const StagedScene s(R"({ "camera": { "origin": [2, -6, 3], "fov": 22 },
    "film": { "resolution": [32, 24], "layers": ["jacobian", { "type": "certificate", "as": "Proof" }] },
    "objects": [ { "type": "sphere_tiling", "solver": "newton" }, { "type": "sphere", "center": [0.9, 0.9, 0.9], "radius": 0.4 },
                 { "type": "gc_octahedron", "transform": [ { "scale": 0.05 }, { "translate": [-1, -1, 0.6] } ] } ] })");
  const Film film = s.render(1);
  const auto value = [&](std::size_t channel, int x, int y) {
    return static_cast<double>(film.layers[3 + channel].values[film.index(x, y)]);
  };
  REQUIRE(film.layers.size() == 3 + 7);
  CHECK(film.layers[3].channel == "Proof.means");
  CHECK(film.layers[8].channel == "Proof.point_error");
  const Certifier certifier(s.tracer);
  long hits = 0, misses = 0, wrong = 0, below = 0;
  WorstCase loose;
  std::string worst = "none";
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const Ray ray = ray_of(s, x, y);
      const Hit hit = s.tracer.closest(ray);
      const Certificate c = certifier.certify(ray, hit);
      ++(hit ? hits : misses);
      if (value(0, x, y) != 1.0 + static_cast<int>(c.means) || value(1, x, y) != (c.exists ? 1.0 : 0.0) ||
          value(2, x, y) != (c.unique ? 1.0 : 0.0) || value(3, x, y) != (c.first ? 1.0 : 0.0) ||
          value(6, x, y) != static_cast<double>(c.pieces))
        ++wrong, worst = fmt::format("({}, {})", x, y);
      // A bound of what was measured, and above it by a float's roundoff only.
      for (const auto& [channel, bound] : {std::pair{4, c.t_error}, {5, c.point_error}}) {
        const double stored = value(static_cast<std::size_t>(channel), x, y);
        if (!hit) {
          wrong += stored != 0.0;
          continue;
        }
        below += stored < bound;
        loose.add(stored - bound, bound * 0x1p-23, [&] { return fmt::format("({}, {})", x, y); });
      }
    }
  INFO("wrong: " << wrong << ", " << worst << "; floats below their bound: " << below);
  INFO(loose.text());
  CHECK(wrong == 0);
  CHECK(below == 0);
  CHECK(loose.failures() == 0);
  CHECK(hits > 100);
  CHECK(misses > 100);
  CHECK(unresolved_pixels(film, s.scene.film.layers) == 0u);
}

TEST_CASE("pixels without a certificate are counted, whatever stands in their place",
          "[layers][certificate]") {
  const StagedScene s(R"({ "film": { "resolution": [4, 3], "layers": ["work", "certificate"] },
    "objects": [ { "type": "sphere" } ] })");
  Film film = s.render(1);
  std::vector<float>& means = film.layers[5].values;
  REQUIRE(film.layers[5].channel == "Certificate.means");
  CHECK(unresolved_pixels(film, s.scene.film.layers) == 0u);
  means[3] = 4.0f, means[5] = 0.0f, means[7] = std::numeric_limits<float>::quiet_NaN();
  CHECK(unresolved_pixels(film, s.scene.film.layers) == 3u);
  CHECK(!unresolved_pixels(film, {}));
  // A ray whose hit is not the first has no certificate, and bounds that bound nothing.
  const Ray ray{{0.0, -3.0, 0.0}, {0.0, 1.0, 0.0}};
  const std::vector<Hit> both = s.tracer.all(ray);
  REQUIRE(both.size() == 2);
  double values[7] = {};
  s.scene.film.layers[1].function(s.world, ray, both[1], values);
  CHECK(values[0] == 4.0);
  CHECK(values[3] == 0.0);
  CHECK(values[4] == std::numeric_limits<double>::infinity());
  CHECK(values[5] == std::numeric_limits<double>::infinity());
}

TEST_CASE("a study spreads its colours over the channel's own range", "[layers][certificate]") {
  const auto legend_of = [](const std::string& keys) {
    const StagedScene s(fmt::format(
        R"({{ "integrator": {{ "type": "study", "layer": "certificate" {} }}, "objects": [ {{ "type": "sphere" }} ] }})",
        keys));
    return s.scene.integrator->legend().value();
  };
  const Legend means = legend_of("");
  CHECK(means.title == "Certificate.means (1 interval, 2 extended, 3 boundary, 4 unresolved)");
  CHECK((means.low == 1.0 && means.high == 4.0 && !means.logarithmic));
  const Legend own = legend_of(R"(, "channel": "t_error")");
  CHECK((own.low == 1e-18 && own.high == 1e-8 && own.logarithmic));
  const Legend given = legend_of(R"(, "channel": "t_error", "range": [0, 1e-3])");
  CHECK((given.low == 0.0 && given.high == 1e-3 && !given.logarithmic));
  const Legend unset = legend_of(R"(, "channel": "first")");
  CHECK((unset.low == 0.0 && unset.high == 1.0 && !unset.logarithmic));
}

TEST_CASE("render says how many pixels have no certificate", "[commands][certificate]") {
  const std::string folder = fresh_folder("render_certificate");
  write_text_file(folder + "/s.json", R"({ "objects": [ { "type": "sphere_octant" } ] })");
  ProcessOptions options;
  options.folder = folder;
  const ProcessResult with = run_rondure(
      {"render", "s.json", "--resolution", "20x15", "--spp", "1", "--layers", "certificate"}, options);
  INFO(with.err);
  CHECK(with.exit_code == 0);
  CHECK(with.err.find("s.exr: 0 of 300 pixels without a certificate\n") != std::string::npos);
  const ProcessResult without =
      run_rondure({"render", "s.json", "--resolution", "4x3", "--spp", "1"}, options);
  CHECK(without.exit_code == 0);
  CHECK(without.err.find("certificate") == std::string::npos);
}

TEST_CASE("no pixel of a shipped scene is without a certificate", "[layers][certificate]") {
  const bool soak = soak_part() > 0.0;
  std::size_t pixels = 0, hits = 0, unresolved = 0, scenes = 0, by_means[5] = {};
  std::string failed;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_folder() + "/scenes")) {
    const std::string path = entry.path().string();
    if (entry.path().extension() != ".json" || path.find("/schema/") != std::string::npos) continue;
    SceneOverrides overrides;
    overrides.spp = 1;
    overrides.integrator = "normals";
    overrides.layers = {"certificate"};
    if (!soak) {  // the scene's own shape, small
      const FilmSettings own = read_scene(path, StagedScene::builtins(), {}).film;
      overrides.resolution = {40, std::max(1, 40 * own.height / own.width)};
    }
    const StagedScene s(read_scene(path, StagedScene::builtins(), overrides));
    const Film film = s.render();
    const std::size_t here = unresolved_pixels(film, s.scene.film.layers).value();
    ++scenes, pixels += film.geometry.size(), unresolved += here;
    if (here > 0) failed += fmt::format("\n  {}: {} of {}", path, here, film.geometry.size());
    for (const PixelGeometry& pixel : film.geometry) hits += pixel.surface >= 0;
    for (const float code : film.layers[0].values) ++by_means[static_cast<int>(code)];
  }
  const std::string text = fmt::format(
      "{} pixels of {} scenes, {} hits: {} by intervals, {} in extended precision, {} on a boundary, {} "
      "unresolved",
      pixels, scenes, hits, by_means[1], by_means[2], by_means[3], unresolved);
  WARN(text);
  INFO(failed);
  CHECK(unresolved == 0);
  CHECK(hits > pixels / 4);
  CHECK(scenes >= 50);
}

}  // namespace
}  // namespace rondure
