// The film's extra layers: where they come from, and that they depend on nothing but the pixel.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include "renderer/film/exr.h"
#include "renderer/film/resume_state.h"
#include "tests/catch.h"
#include "tests/process.h"
#include "tests/render/staged_scene.h"
#include "tests/scene/messages.h"

namespace rondure {
namespace {

const char* layered_scene = R"({
  "camera": { "type": "perspective", "origin": [0, -4, 1], "target": [0, 0, 0], "fov": 35 },
  "film": { "resolution": [33, 21], "layers": ["jacobian", { "type": "jacobian", "as": "Again" }] },
  "sampling": { "spp": 1 },
  "objects": [ { "type": "sphere_tiling", "topology": "hemispheres" },
               { "type": "sphere", "center": [1.2, 0, 0], "radius": 0.3 } ] })";

// The first and last channel's values in a window.
void compare(const Film& whole, const Film& part, int& failures, int& lit) {
  const Window& w = part.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      for (std::size_t c = 0; c < part.layers.size(); ++c) {
        const float a = whole.layers[c].values[whole.index(x, y)],
                    b = part.layers[c].values[part.index(x, y)];
        failures += a != b;
        lit += b != 0.0f;
      }
    }
  }
}

TEST_CASE("layers do not depend on threads, crops or interruptions", "[layers]") {
  const StagedScene s(layered_scene);
  const Film whole = s.render();
  REQUIRE(whole.layers.size() == 6);
  CHECK(whole.layers[0].channel == "Jacobian.sine");
  CHECK(whole.layers[5].channel == "Again.smallest");
  int failures = 0, lit = 0;
  RenderOptions options;
  options.threads = 1;
  compare(whole, s.render(0, options), failures, lit);
  options.crop = Window{5, 3, 31, 17};
  compare(whole, s.render(0, options), failures, lit);
  const std::string path = fresh_folder("layers_resume") + "/a.exr.state";
  Film first = make_film(s.scene, {}), second = make_film(s.scene, {});
  add_samples(first, 16, s.scene, s.world, {});
  write_resume_state(path, "key", first);
  REQUIRE(read_resume_state(path, "key", second));
  add_samples(second, 17, s.scene, s.world, {});
  compare(whole, second, failures, lit);
  CHECK(failures == 0);
  CHECK(lit > 3000);
  // Twice the same layer, and nothing where nothing or no patch is hit.
  for (std::size_t at = 0; at < whole.geometry.size(); ++at) {
    failures += whole.layers[0].values[at] != whole.layers[3].values[at];
    const bool patch = whole.geometry[at].surface == 0;
    failures += (whole.layers[2].values[at] != 0.0f) != patch;
  }
  CHECK(failures == 0);
}

TEST_CASE("the file holds the layers under their names", "[layers]") {
  const StagedScene s(layered_scene);
  const Film film = s.render();
  const std::string path = fresh_folder("layers_exr") + "/a.exr";
  write_exr(path, film, {});
  Imf::InputFile file(path.c_str());
  int channels = 0;
  for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) ++channels;
  CHECK(channels == 21 + 6);
  std::vector<float> values(film.geometry.size());
  Imf::FrameBuffer buffer;
  buffer.insert("Again.condition", Imf::Slice::Make(Imf::FLOAT, values.data(), file.header().dataWindow()));
  file.setFrameBuffer(buffer);
  file.readPixels(0, film.height() - 1);
  CHECK(values == film.layers[4].values);
}

TEST_CASE("the jacobian layer measures the tangents", "[layers]") {
  // A parallelogram of sides 2 and 1 at 30 degrees, and a square seen from above.
  const StagedScene s(R"({
    "camera": { "type": "orthographic", "origin": [0, 0, 5], "target": [0, 0, 0], "up": [0, 1, 0], "height": 0.1 },
    "film": { "resolution": [1, 1], "layers": ["jacobian"] },
    "objects": [ { "type": "bezier", "patches": [ { "degree": [1, 1], "net": [
      [[-1.5, -0.3, 0, 1], [-0.6339745962155614, 0.2, 0, 1]], [[0.5, -0.3, 0, 1], [1.3660254037844386, 0.2, 0, 1]] ] } ] } ] })");
  const Film film = s.render(1);
  REQUIRE(film.geometry[0].surface == 0);
  // |Su| = 2, |Sv| = 1, Su.Sv = sqrt(3): the squares of the singular values are (5 -+ sqrt(21)) / 2.
  const double low = std::sqrt((5.0 - std::sqrt(21.0)) / 2.0),
               high = std::sqrt((5.0 + std::sqrt(21.0)) / 2.0);
  CHECK(film.layers[0].values[0] == Approx(0.5).epsilon(1e-6));
  CHECK(film.layers[1].values[0] == Approx(high / low).epsilon(1e-6));
  CHECK(film.layers[2].values[0] == Approx(low).epsilon(1e-6));
}

TEST_CASE("a layer that gives no number ends the render, an infinite one is stored", "[layers]") {
  StagedScene s(R"({ "film": { "resolution": [2, 2] }, "objects": [ { "type": "sphere" } ] })");
  double given = std::numeric_limits<double>::infinity();
  s.scene.film.layers.push_back(
      {"own", {"Own.x"}, [&](const World&, const Ray&, const Hit&, double* values) { values[0] = given; }});
  CHECK(s.render(1).layers[0].values[3] == std::numeric_limits<float>::max());
  given = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(s.render(1), "the layer \"Own.x\" gave no number for a pixel");
  s.scene.film.layers[0].function = [](const World&, const Ray&, const Hit&, double*) {
    throw std::runtime_error("no luck");
  };
  CHECK_THROWS_WITH(s.render(1), "the layer \"own\" failed: no luck");
}

TEST_CASE("an override names the film's layers and keeps their parameters", "[layers]") {
  SceneOverrides overrides;
  overrides.layers = {"jacobian"};
  const StagedScene kept(layered_scene, overrides);
  CHECK(kept.scene.film.layers.size() == 2);  // both have that type
  const StagedScene added(R"({ "objects": [ { "type": "sphere" } ] })", overrides);
  REQUIRE(added.scene.film.layers.size() == 1);
  CHECK(added.scene.film.layers[0].channels[1] == "Jacobian.condition");
  overrides.layers = {"jacobien"};
  CHECK(
      first_line(message_of(
          [&] { read_scene_text("s.json", layered_scene, StagedScene::builtins(), overrides); })) ==
      "s.json: layers[0]: unknown layer \"jacobien\"; did you mean \"jacobian\"? (set on the command line)");
}

}  // namespace
}  // namespace rondure
