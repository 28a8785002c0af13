#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/catch.h"
#include "tests/render/staged_scene.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using std::numbers::pi;

std::string lamp_scene(const std::string& object, const std::string& lights = "[]") {
  return fmt::format(
      R"({{ "materials": {{ "lamp": {{ "type": "diffuse", "albedo": 0, "emission": [2, 3, 4] }} }},
    "lights": {}, "objects": [ {{ "material": "lamp", {} }} ] }})",
      lights, object);
}

struct Lamp {
  const char* object;
  double radius;  // of the sphere that it is; 0 for other shapes
};

constexpr dvec3 center{0.5, -0.25, 1.0};

const Lamp lamps[] = {
    {R"("type": "sphere", "center": [0.5, -0.25, 1], "radius": 0.7)", 0.7},
    {R"("type": "sphere_tiling", "topology": "cube", "center": [0.5, -0.25, 1], "radius": 0.7)", 0.7},
    {R"("type": "sphere_tiling", "topology": "hemispheres", "center": [0.5, -0.25, 1], "radius": 0.7)", 0.7},
    {R"("type": "sphere_octant", "center": [0.5, -0.25, 1], "radius": 0.7)", 0.7},
    {R"("type": "sphere", "transform": [[1, 0.2, 0, 0.5],
        [0, 0.5, 0.3, -0.25], [0, 0, 0.8, 1], [0, 0, 0, 1]])",
     0.0},
    {R"("type": "bezier", "patches": [ { "kind": "triangle", "degree": 2, "net": {
        "200": [1.5, -0.25, 1, 1], "020": [0.5, -0.25, 2, 1], "002": [0.5, 0.75, 0.5, 1],
        "110": [1.2, 0.1, 1.7, 1.3], "101": [1.1, 0.5, 0.9, 1.1], "011": [0.6, 0.4, 1.5, 1.2] } } ])",
     0.0},
};

TEST_CASE("what is sampled on an emissive surface is what a ray finds there", "[shading]") {
  for (const Lamp& lamp : lamps) {
    const StagedScene s(lamp_scene(lamp.object));
    WorstCase worst;
    int misses = 0, met = 0;
    for (int i = 0; i < 4000; ++i) {
      Sampler sampler(3, i, 0, 0);
      const dvec3 way(sampler.next_1d() - 0.5, sampler.next_1d() - 0.5, sampler.next_1d() - 0.5);
      const dvec3 point = center + 3.0 * glm::normalize(way);
      const LightSample light = s.world.sample_light(point, sampler.next_1d(), sampler.next_2d());
      if (light.pdf == 0.0) continue;  // the far side of the lamp
      const Hit hit = s.tracer.closest(Ray{point, light.direction});
      // Grazing rays may pass beside the sampled point by rounding; an open surface may also hide its own
      // samples.
      const double cosine = hit ? -glm::dot(hit.normal, light.direction) : 0.0;
      if (!hit || std::abs(hit.t / light.distance - 1.0) > 1e-6) {
        ++misses;
        continue;
      }
      ++met;
      if (cosine < 0.01) continue;
      const auto describe = [&] { return fmt::format("sample {}, cosine {}", i, cosine); };
      worst.add(std::abs(hit.t / light.distance - 1.0), 1e-11,
                describe);  // rounding, over a cosine of 0.01 twice
      // Relative: the parameters' error of some 1e-14 over |du| near a singular corner, and 1e-14 over the
      // cosine.
      worst.add(std::abs(s.world.light_pdf(point, hit) / light.pdf - 1.0), 1e-8, describe);
      worst.add(s.world.emitted(hit, -light.direction) == light.radiance ? 0.0 : 1.0, 0.5, describe);
    }
    INFO(lamp.object << "\nmet " << met << ", missed " << misses << "; " << worst.text());
    CHECK(worst.failures() == 0);
    CHECK(met > 800);
    CHECK(misses <= (lamp.radius > 0.0 ? 4 : 400));
  }
}

TEST_CASE("light from a sphere lamp, however tiled, is the sphere's", "[shading]") {
  for (const Lamp& lamp : lamps) {
    if (lamp.radius == 0.0) continue;
    const StagedScene s(lamp_scene(lamp.object));
    const double d = 2.5;
    const dvec3 toward = glm::normalize(dvec3(-1, 2, 0.5));
    const dvec3 point = center - d * toward;
    double irradiance = 0.0, squares = 0.0, solid_angle = 0.0;
    constexpr int n = 1 << 16;
    for (int i = 0; i < n; ++i) {
      Sampler sampler(4, i, 0, 0);  // independent samples, so that the standard error means what it says
      const double choice = sampler.next_1d();
      const LightSample light = s.world.sample_light(point, choice, sampler.next_2d());
      if (light.pdf == 0.0) continue;
      const double value = light.radiance.x * glm::dot(light.direction, toward) / light.pdf;
      irradiance += value / n;
      squares += value * value / n;
      solid_angle += 1.0 / light.pdf / n;
    }
    const double error = std::sqrt((squares - irradiance * irradiance) / n);
    // A sphere seen from a point that faces its centre: E = pi L (R / d)^2.
    const double ratio = lamp.radius / d;
    INFO(lamp.object << "\n" << irradiance << " +- " << error);
    CHECK(std::abs(irradiance - pi * 2.0 * ratio * ratio) < 5.0 * error);
    CHECK(error < 0.01 * irradiance);
    // Its solid angle, by the mean of 1 / pdf: some ten thousandths of spread more than E.
    CHECK(std::abs(solid_angle - 2.0 * pi * (1.0 - std::sqrt(1.0 - ratio * ratio))) < 6.0 * error);
  }
}

TEST_CASE("emission leaves the outward side alone", "[shading]") {
  const StagedScene s(lamp_scene(lamps[1].object));
  const Hit inside = s.tracer.closest(Ray{center, {0, 0, 1}});
  REQUIRE(inside);
  CHECK(s.world.emitted(inside, {0, 0, -1}) == dvec3(0.0));
  CHECK(s.world.emitted(inside, {0, 0, 1}) == dvec3(2, 3, 4));
  CHECK(s.world.light_pdf(center, inside) == 0.0);
}

TEST_CASE("point and directional lights give what their names say", "[shading]") {
  const StagedScene point(
      R"({ "lights": [ { "type": "point", "position": [0, 0, 2], "intensity": [8, 4, 2] } ],
    "objects": [ { "type": "sphere", "center": [0, 0, 1], "radius": 0.5 } ] })");
  const LightSample p = point.world.sample_light({0, 0, 0}, 0.3, {0.5, 0.5});
  CHECK(p.delta);
  CHECK(p.pdf == 1.0);
  CHECK(p.radiance == dvec3(2.0, 1.0, 0.5));
  CHECK(p.direction == dvec3(0, 0, 1));
  Hit from;  // in free space
  CHECK_FALSE(point.world.visible(from, p));
  from.point = {0, 0, 1.6};
  CHECK(point.world.visible(from, point.world.sample_light(from.point, 0.3, {0.5, 0.5})));

  const StagedScene sun(
      R"({ "lights": [ { "type": "directional", "direction": [0, 0, -3], "irradiance": 2 } ],
    "objects": [ { "type": "sphere", "center": [0, 0, 1], "radius": 0.5 } ] })");
  const LightSample s = sun.world.sample_light({0, 0, 0}, 0.3, {0.5, 0.5});
  CHECK((s.delta && s.pdf == 1.0 && s.radiance == dvec3(2.0) && s.direction == dvec3(0, 0, 1)));
  from.point = {0, 0, 0};
  CHECK_FALSE(sun.world.visible(from, s));
  from.point = {0.6, 0, 0};
  CHECK(sun.world.visible(from, s));
}

TEST_CASE("the choice among lights is accounted for", "[shading]") {
  const StagedScene s(R"({ "materials": { "lamp": { "emission": 5 } }, "lights": [
      { "type": "point", "position": [0, 0, 4], "intensity": 8 },
      { "type": "directional", "direction": [0, 0, -1], "irradiance": 2 } ],
    "objects": [ { "type": "sphere", "center": [0, 3, 0], "radius": 0.5, "material": "lamp" } ] })");
  // Irradiance at the origin facing up, left and right: 8 / 16 + 2, and 5 pi / 36 of the ball along y.
  dvec3 up(0.0);
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    Sampler sampler(9, 0, 0, static_cast<std::uint32_t>(i));
    const double choice = sampler.next_1d();
    const LightSample l = s.world.sample_light({0, 0, 0}, choice, sampler.next_2d());
    if (l.pdf > 0.0) up += l.radiance.x * l.direction / l.pdf / double(n);
  }
  // Stratified choices: shares are good to 1 / n each, the ball's points to a percent.
  CHECK(up.z == Approx(2.5).epsilon(0.01));
  CHECK(up.y == Approx(5.0 * pi / 36.0).epsilon(0.01));
}

}  // namespace
}  // namespace rondure
