#include "renderer/render/render.h"

#include <atomic>
#include <cstring>
#include <limits>

#include "renderer/film/image.h"
#include "renderer/film/resume_state.h"
#include "renderer/render/resume_key.h"
#include "tests/catch.h"
#include "tests/process.h"
#include "tests/render/staged_scene.h"

namespace rondure {
namespace {

const char* small_scene = R"({
  "camera": { "type": "perspective", "origin": [0, -4, 1], "target": [0, 0, 0], "fov": 35, "aperture": 0.05 },
  "film": { "resolution": [45, 37] }, "sampling": { "spp": 20, "seed": 5 },
  "materials": { "clay": { "type": "diffuse", "albedo": [0.6, 0.5, 0.4] }, "glass": { "type": "dielectric" },
                 "metal": { "type": "rough_conductor" }, "lamp": { "emission": 9 } },
  "lights": [ { "type": "constant", "radiance": 0.5 } ],
  "objects": [ { "type": "sphere_tiling", "topology": "cube", "material": "clay" },
               { "type": "sphere", "center": [-0.8, -1.5, 0], "radius": 0.3, "material": "glass" },
               { "type": "sphere_octant", "center": [0.8, -1.5, 0], "radius": 0.3, "material": "metal" },
               { "type": "sphere", "center": [0, -1, 2], "radius": 0.2, "material": "lamp" } ] })";

bool same_bits(const std::vector<PixelSums>& a, const std::vector<PixelSums>& b) {
  return a.size() == b.size() && !a.empty() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(PixelSums)) == 0;
}

TEST_CASE("the picture's bits do not depend on threads", "[render]") {
  const StagedScene s(small_scene);
  RenderOptions options;
  options.threads = 1;
  const Film one = s.render(0, options);
  for (const int threads : {2, 3, 7}) {
    options.threads = threads;
    const Film many = s.render(0, options);
    CHECK(same_bits(one.whole, many.whole));
    CHECK(same_bits(one.rest, many.rest));
  }
  CHECK(picture_mean(one).mean > 0.1);
  CHECK(one.rejected == 0);
}

TEST_CASE("a crop holds the bits of the whole picture", "[render]") {
  const StagedScene s(small_scene);
  const Film whole = s.render(3);
  RenderOptions options;
  options.crop = Window{7, 11, 30, 36};
  const Film part = s.render(3, options);
  int failures = 0;
  for (int y = 11; y < 36; ++y) {
    for (int x = 7; x < 30; ++x) {
      const FilmSample a = whole.mean(x, y), b = part.mean(x, y);
      failures += a.color != b.color || a.normal != b.normal || a.alpha != b.alpha || a.albedo != b.albedo;
      failures += whole.geometry[whole.index(x, y)].point != part.geometry[part.index(x, y)].point;
    }
  }
  CHECK(failures == 0);
  for (const Window& bad :
       {Window{0, 0, 46, 3}, Window{5, 5, 5, 9}, Window{-1, 0, 3, 3}, Window{9, 4, 3, 30}}) {
    options.crop = bad;
    CHECK_THROWS_AS(make_film(s.scene, options), std::invalid_argument);
  }
}

TEST_CASE("a film taken up again has the bits of one run", "[render]") {
  const StagedScene s(small_scene);
  const Film straight = s.render(53);
  const std::string path = fresh_folder("resume") + "/a.exr.state";
  Film first = make_film(s.scene, {});
  CHECK_FALSE(read_resume_state(path, "key", first));
  add_samples(first, 20, s.scene, s.world, {});  // not a multiple of the chunk
  write_resume_state(path, "key", first);
  Film second = make_film(s.scene, {});
  REQUIRE(read_resume_state(path, "key", second));
  CHECK(second.samples == 16);
  add_samples(second, 48, s.scene, s.world, {});
  add_samples(second, 53, s.scene, s.world, {});
  CHECK(same_bits(straight.whole, second.whole));
  CHECK(same_bits(straight.rest, second.rest));
  CHECK(second.geometry[300].point == straight.geometry[300].point);

  Film other = make_film(s.scene, {});
  CHECK_THROWS_WITH(
      read_resume_state(path, "another", other),
      path + ": holds another render; delete it or choose another output\n  found:  key\n  wanted: another");
  const std::string bytes = read_text_file(path);
  // No bit of it is taken for another: not of what stands before the sums, nor of these.
  int unnoticed = 0;
  for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += bit < 800 ? 1 : 80021) {
    std::string changed = bytes;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << bit % 8));
    write_text_file(path, changed);
    try {
      read_resume_state(path, "key", other);
      ++unnoticed;
    } catch (const std::runtime_error&) {
    }
  }
  CHECK(unnoticed == 0);
  write_text_file(path, bytes.substr(0, 1000));
  CHECK_THROWS_WITH(read_resume_state(path, "key", other),
                    path + ": the file is damaged; delete it to start anew");
}

TEST_CASE("the key of saved sums tells scenes apart, also by what their text only points to", "[render]") {
  const std::string file = fresh_folder("resume_key") + "/sky.png";
  write_png(file, 4, 2, std::vector<unsigned char>(24, 255));
  const std::string text = R"({ "film": { "resolution": [8, 8] }, "objects": [ { "type": "sphere_octant" } ],
    "lights": [ { "type": "environment", "file": ")" +
                           file + R"(" } ] })";
  Scene scene = read_scene_text("test.json", text, StagedScene::builtins());
  const Film film = make_film(scene, {});
  const std::string key = resume_key(scene, film);
  CHECK(resume_key(read_scene_text("elsewhere.json", text, StagedScene::builtins()), film) == key);
  points_of(scene.objects[0].traced.surface.patches[3])[4].y += 0.125;
  CHECK(resume_key(scene, film) != key);
  points_of(scene.objects[0].traced.surface.patches[3])[4].y -= 0.125;
  CHECK(resume_key(scene, film) == key);
  write_png(file, 4, 2, std::vector<unsigned char>(24, 254));
  CHECK(resume_key(scene, film) != key);
  write_png(file, 4, 2, std::vector<unsigned char>(24, 255));
  // Plugins by what their files hold.
  const std::string plugin = fresh_folder("resume_key_plugin") + "/p.so";
  write_text_file(plugin, "one");
  const std::string with_plugin = resume_key(scene, film, {plugin});
  CHECK(with_plugin != key);
  write_text_file(plugin, "two");
  CHECK(resume_key(scene, film, {plugin}) != with_plugin);
  write_text_file(plugin, "one");
  CHECK(resume_key(scene, film, {plugin}) == with_plugin);
  CHECK_THROWS_WITH(resume_key(scene, film, {plugin + "x"}), "plugin " + plugin + "x: it cannot be read");
  scene.sampling.seed = 2;
  CHECK(resume_key(scene, film) != key);
}

// Gives a wrong number at some pixels.
class Faulty : public Integrator {
 public:
  explicit Faulty(double wrong) : wrong_(wrong) {}
  dvec3 radiance(const World&, const Ray& ray, const Hit&, Sampler&) const override {
    return ray.direction.x > 0.0 ? dvec3(1.0, wrong_, 1.0) : dvec3(1.0);
  }

 private:
  double wrong_;
};

TEST_CASE("no wrong number reaches the film, and each is counted", "[render]") {
  for (const double wrong :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e-9, 3.5e38}) {
    StagedScene s(small_scene);
    s.scene.integrator = std::make_unique<Faulty>(wrong);
    const Film film = s.render(16);
    // Half of the picture, but for the middle column, where the filter decides.
    CHECK(film.rejected >= 22u * 37u * 15u);
    CHECK(film.rejected <= 23u * 37u * 16u + 600u);
    const double black = 1.0 - picture_mean(film).mean;
    CHECK(black == Approx(double(film.rejected) / (45.0 * 37.0 * 16.0)).epsilon(1e-12));
    CHECK(film.whole_rejected == film.rejected);
  }
}

TEST_CASE("a render stops when asked", "[render]") {
  const StagedScene s(small_scene);
  std::atomic<int> asked{0};
  RenderOptions options;
  options.stop = [&] { return ++asked > 3; };
  CHECK_THROWS_AS(s.render(64, options), Interrupted);
}

TEST_CASE("progress counts every pixel", "[render]") {
  const StagedScene s(small_scene);
  std::atomic<std::size_t> pixels{0};
  RenderOptions options;
  options.progress = [&](std::size_t count) { pixels += count; };
  s.render(1, options);
  CHECK(pixels == 45u * 37u);
}

}  // namespace
}  // namespace rondure
