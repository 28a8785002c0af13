#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/catch.h"
#include "tests/render/staged_scene.h"

namespace rondure {
namespace {

// Path tracing at its plainest, with nothing shared but the materials: no light samples, no roulette.
class BruteForce : public Integrator {
 public:
  explicit BruteForce(int depth) : depth_(depth) {}
  dvec3 radiance(const World& world, const Ray& camera_ray, const Hit& first,
                 Sampler& sampler) const override {
    dvec3 result(0.0), throughput(1.0);
    Ray ray = camera_ray;
    Hit hit = first;
    PassedWalls passed;
    for (int depth = 0;; ++depth) {
      if (!hit) return result + throughput * world.background(ray.direction);
      result += throughput * world.emitted(hit, -ray.direction);
      if (depth == depth_) return result;
      sampler.start_block(depth + 1);
      const double lobe = sampler.next_1d();
      const auto s =
          sample_scattering(world.material(hit), hit.normal, -ray.direction, lobe, sampler.next_2d());
      if (!s) return result;
      throughput *= s->weight;
      ray = spawn(hit, s->direction, passed);
      hit = world.tracer().closest(ray);
      passed.arrive(ray, hit);
    }
  }

 private:
  int depth_;
};

// A floor of radius 1000, a ball in the middle, a big lamp beside it.
std::string room(const std::string& integrator, const std::string& ball, const std::string& lamp = "sphere") {
  return fmt::format(R"({{
    "camera": {{ "type": "perspective", "origin": [0, -5, 2], "target": [0, 0, 0.5], "fov": 40 }},
    "film": {{ "resolution": [16, 12], "filter": "box" }}, "sampling": {{ "spp": 400, "seed": 3 }},
    "integrator": {},
    "materials": {{ "floor": {{ "albedo": [0.5, 0.6, 0.7] }}, "ball": {},
                    "lamp": {{ "albedo": 0, "emission": [3, 2, 1] }} }},
    "lights": [ {{ "type": "constant", "radiance": [0.1, 0.2, 0.3] }} ],
    "objects": [ {{ "type": "sphere", "center": [0, 0, -1000], "radius": 1000, "material": "floor" }},
                 {{ "type": "sphere_tiling", "topology": "cube", "center": [-0.6, 0, 0.7], "radius": 0.7,
                    "material": "ball" }},
                 {{ "type": "{}", "center": [1.4, 0, 1.2], "radius": 0.8, "material": "lamp" }} ] }})",
                     integrator, ball, lamp);
}

void check_close(const Film& a, const Film& b, double accuracy) {
  for (int c = 0; c < 3; ++c) {
    const Estimate p = picture_mean(a, c), q = picture_mean(b, c);
    const double error = std::hypot(p.error, q.error);
    INFO("channel " << c << ": " << p.mean << " +- " << p.error << " against " << q.mean << " +- "
                    << q.error);
    // Samples of one pixel are stratified, so that the measured error is on the large side.
    CHECK(std::abs(p.mean - q.mean) < 4.0 * error);
    CHECK(error < accuracy * p.mean);
  }
}

TEST_CASE("light samples and roulette leave the mean of path tracing alone", "[integrators]") {
  for (const char* ball :
       {R"({ "type": "diffuse", "albedo": 0.8 })", R"({ "type": "rough_conductor", "roughness": 0.4 })",
        R"({ "type": "dielectric" })", R"({ "type": "mirror" })"}) {
    INFO(ball);
    StagedScene s(room(R"({ "type": "path", "max_depth": 6, "min_depth": 1 })", ball));
    const Film path = s.render();
    s.scene.integrator = std::make_unique<BruteForce>(6);
    check_close(path, s.render(), 0.02);
  }
  // Lamps of patches, sampled by cells.
  for (const char* lamp : {"sphere_octant", "sphere_tiling"}) {
    INFO(lamp);
    StagedScene s(room(R"({ "type": "path", "max_depth": 3 })", R"({ "albedo": 0.8 })", lamp));
    const Film path = s.render();
    s.scene.integrator = std::make_unique<BruteForce>(3);
    check_close(path, s.render(), 0.02);
  }
}

TEST_CASE("direct light is path tracing of one scattering", "[integrators]") {
  const StagedScene direct(room(R"({ "type": "direct" })", R"({ "type": "rough_conductor" })"));
  StagedScene brute(room(R"("path")", R"({ "type": "rough_conductor" })"));
  brute.scene.integrator = std::make_unique<BruteForce>(1);
  check_close(direct.render(), brute.render(), 0.02);
}

TEST_CASE("direct light reaches through mirrors and glass", "[integrators]") {
  // A floor seen in a mirror above and behind: what the mirror shows is what path tracing of two scatterings
  // shows.
  const std::string scene = R"({
    "camera": { "type": "orthographic", "origin": [0, 0, 2], "target": [0, 0, 9], "up": [0, 1, 0],
                "height": 0.2 },
    "film": { "resolution": [8, 8] }, "sampling": { "spp": 64 },
    "integrator": { "type": "%", "max_depth": 2 },
    "materials": { "mirror": { "type": "mirror", "reflectance": 0.9 }, "floor": { "albedo": 0.5 } },
    "lights": [ { "type": "point", "position": [0, 0, 1], "intensity": 2 } ],
    "objects": [ { "type": "sphere", "center": [0, 0, 105], "radius": 100, "material": "mirror" },
                 { "type": "sphere", "center": [0, 0, -100], "radius": 100, "material": "floor" } ] })";
  const auto render = [&](const std::string& integrator) {
    std::string text = scene;
    text.replace(text.find('%'), 1, integrator);
    return picture_mean(StagedScene(text).render());
  };
  const Estimate direct = render("direct"), path = render("path");
  // Straight below the lamp: 0.9 * 0.5 / pi * 2 / 1^2, and less by the square of the distance over at most
  // 0.16.
  CHECK(direct.mean == Approx(0.9 * 0.5 / 3.14159265 * 2.0).epsilon(0.05));
  CHECK(path.mean == Approx(direct.mean).epsilon(1e-9));  // no sampling but of pixels, and those are the same
}

TEST_CASE("a floor under a ball lamp has the radiance of the formula", "[integrators]") {
  // Irradiance pi L (R / d)^2 on a floor that faces the lamp's centre; radiance is albedo / pi times that.
  for (const char* integrator : {"path", "direct"}) {
    for (const char* lamp : {"sphere", "sphere_tiling", "sphere_octant"}) {
      const StagedScene s(fmt::format(
          R"({{ "camera": {{ "type": "orthographic", "origin": [0, 0, 0.5], "target": [0, 0, 0],
                             "up": [0, 1, 0], "height": 1e-4 }},
            "film": {{ "resolution": [4, 4] }}, "sampling": {{ "spp": 4096 }},
            "integrator": {{ "type": "{}", "max_depth": 1 }},
            "materials": {{ "floor": {{ "albedo": 0.8 }}, "lamp": {{ "albedo": 0, "emission": 5 }} }},
            "lights": [],
            "objects": [ {{ "type": "bezier", "material": "floor", "patches": [ {{
                "kind": "tensor", "degree": [1, 1],
                "net": [ [ [-9, -9, 0, 1], [-9, 9, 0, 1] ], [ [9, -9, 0, 1], [9, 9, 0, 1] ] ] }} ] }},
              {{ "type": "{}", "center": [0, 0, 3], "radius": 1, "material": "lamp" }} ] }})",
          integrator, lamp));
      const Estimate e = picture_mean(s.render());
      INFO(integrator << ", " << lamp << ": " << e.mean << " +- " << e.error);
      CHECK(std::abs(e.mean - 0.8 * 5.0 / 9.0) < 4.0 * e.error);
      CHECK(e.error < 0.01 * e.mean);
    }
  }
}

TEST_CASE("normals are shown as colours", "[integrators]") {
  const StagedScene s(R"({ "integrator": "normals", "film": { "resolution": [31, 31], "filter": "box" },
    "camera": { "type": "orthographic", "origin": [0, -4, 0], "height": 2.5 },
    "objects": [ { "type": "sphere" } ] })");
  const Film film = s.render(1);
  int failures = 0, met = 0;
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 31; ++x) {
      const FilmSample m = film.mean(x, y);
      met += m.alpha > 0.0;
      const dvec3 expected = m.alpha > 0.0 ? 0.5 * (m.normal + dvec3(1.0)) : dvec3(0.0);
      failures += m.color != expected || (m.alpha > 0.0 && std::abs(glm::length(m.normal) - 1.0) > 1e-14);
      failures += m.alpha > 0.0 && m.normal.y > 0.0;
    }
  }
  CHECK(failures == 0);
  CHECK(std::abs(met - 31 * 31 * 3.14159 / 6.25) < 40);  // a disk of radius 1 in a window of 2.5
}

}  // namespace
}  // namespace rondure
