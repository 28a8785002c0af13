// Lamps that are analytic spheres: sampled by the solid angle in which they are seen.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderer/sampling/warps.h"
#include "renderer/shading/sphere_cone.h"
#include "renderer/shading/surface_light.h"
#include "tests/catch.h"
#include "tests/render/staged_scene.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using std::numbers::pi;

constexpr double radius = 0.7;
constexpr dvec3 lamp_center{0.5, -0.25, 1.0};

std::string sphere_lamp_scene(const std::string& extra = "") {
  return R"({ "materials": { "lamp": { "albedo": 0, "emission": 2 }, "paper": { "albedo": 0.5 } },
    "lights": [], "objects": [ { "type": "sphere", "material": "lamp", "center": [0.5, -0.25, 1], "radius": 0.7 })" +
         extra + " ] }";
}

struct Moments {
  double mean = 0.0, variance = 0.0;  // of one sample
};

template <class Value>
Moments moments(int count, Value&& value) {
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(7, i, 0, 0);  // independent samples, so that the standard error means what it says
    const double v = value(sampler);
    sum += v, squares += v * v;
  }
  const double mean = sum / count;
  return {mean, std::fmax(0.0, squares / count - mean * mean)};
}

TEST_CASE("the irradiance of a sphere lamp is the closed form, at any distance", "[shading]") {
  const StagedScene s(sphere_lamp_scene());
  constexpr int count = 1 << 14;
  for (const double distance : {1.00002, 1.05, 1.5, 4.0, 100.0, 1e6}) {
    // A surface that sees the whole lamp: its tilt is less than the angle from the lamp's rim to 90 degrees.
    for (const double tilt : {0.0, 0.9 * std::acos(1.0 / distance)}) {
      const Frame frame = frame_about(glm::normalize(dvec3(-1, 2, 0.5)));
      const dvec3 point = lamp_center - distance * radius * frame.z;
      const dvec3 normal = std::cos(tilt) * frame.z + std::sin(tilt) * frame.x;
      const auto by_cone = [&](Sampler& sampler) {
        const double choice = sampler.next_1d();
        const LightSample light = s.world.sample_light(point, choice, sampler.next_2d());
        return light.radiance.x * glm::dot(light.direction, normal) / light.pdf;
      };
      // The same by area: what every other surface gets.
      const SurfaceLight lamp(s.tracer.surfaces()[0].surface);
      const auto by_area = [&](Sampler& sampler) {
        sampler.next_1d();
        const SurfaceLight::Sample at = lamp.sample(sampler.next_2d());
        const dvec3 way = glm::normalize(at.point - point);
        const double cosine = -glm::dot(at.normal, way);
        if (!(cosine > 0.0)) return 0.0;
        const dvec3 gap = at.point - point;
        return 2.0 * glm::dot(way, normal) * cosine / (glm::dot(gap, gap) * at.density);
      };
      const double exact = pi * 2.0 * std::cos(tilt) / (distance * distance);
      const Moments cone = moments(count, by_cone), area = moments(count, by_area);
      INFO(distance << " radii, tilt " << tilt << ": " << cone.mean << ", " << exact << ", variances "
                    << cone.variance << ", " << area.variance);
      // Five standard errors, and rounding where the estimate is all but constant.
      CHECK(std::abs(cone.mean - exact) < 5.0 * std::sqrt(cone.variance / count) + 1e-12 * exact);
      // Close by, hardly a sample by area falls where the point sees: its variance is beyond these samples.
      if (distance < 1.5) continue;
      CHECK(std::abs(area.mean - exact) < 5.0 * std::sqrt(area.variance / count));
      CHECK(cone.variance < (tilt == 0.0 ? 0.05 : 0.5) * area.variance);
    }
  }
}

TEST_CASE("a sphere lamp does not hide its own samples", "[shading]") {
  const StagedScene s(sphere_lamp_scene());
  for (const double distance : {1.00002, 1.001, 2.0, 1e6}) {
    Hit from;
    from.point = lamp_center + distance * radius * glm::normalize(dvec3(1, -2, 0.3));
    int hidden = 0;
    for (int i = 0; i < 10000; ++i) {
      Sampler sampler(8, i, 0, 0);
      const double choice = sampler.next_1d();
      const LightSample light = s.world.sample_light(from.point, choice, sampler.next_2d());
      hidden += light.pdf > 0.0 && !s.world.visible(from, light);
    }
    CAPTURE(distance);
    // At the rim the ray's place on the lamp is uncertain by more than visibility allows: one in 10^4 at
    // most.
    CHECK(hidden <= 1);
  }
}

TEST_CASE("the density of directions to a sphere lamp integrates to one", "[shading]") {
  const StagedScene s(sphere_lamp_scene());
  for (const double distance : {1.00002, 1.2, 3.0}) {
    const dvec3 point = lamp_center + distance * radius * glm::normalize(dvec3(1, 1, -1));
    constexpr int count = 1 << 16;
    const Moments m = moments(count, [&](Sampler& sampler) {
      const Hit hit = s.tracer.closest(Ray{point, sample_sphere(sampler.next_2d())});
      return hit ? 4.0 * pi * s.world.light_pdf(point, hit) : 0.0;
    });
    INFO(distance << " radii: " << m.mean);
    CHECK(std::abs(m.mean - 1.0) < 5.0 * std::sqrt(m.variance / count));
    CHECK(m.variance > 0.0);
  }
}

TEST_CASE("a sphere lamp is sampled by area from inside and from very near", "[shading]") {
  CHECK_FALSE(sphere_cone(lamp_center, lamp_center, radius));
  CHECK_FALSE(sphere_cone(lamp_center + dvec3(0, 0, 0.99 * radius), lamp_center, radius));
  CHECK_FALSE(sphere_cone(lamp_center + dvec3(0, 0, 1.00001 * radius), lamp_center, radius));
  CHECK(sphere_cone(lamp_center + dvec3(0, 0, 1.00002 * radius), lamp_center, radius));
  CHECK_FALSE(sphere_cone(lamp_center + dvec3(0, 0, 2.0), lamp_center, 0.0));
  // Straight above, the density per solid angle of points spread over 4 pi R^2, seen from a gap of g: g^2 of
  // that. Half an ulp of z is 10^-11 of the gap.
  const StagedScene s(sphere_lamp_scene());
  const dvec3 point = lamp_center + dvec3(0, 0, 1.00001 * radius);
  const Hit below = s.tracer.closest(Ray{point, {0, 0, -1}});
  REQUIRE(below);
  CHECK(s.world.light_pdf(point, below) == Approx(1e-10 / (4.0 * pi)).epsilon(1e-9));
  // Inside, nothing shines.
  const LightSample dark = s.world.sample_light(lamp_center + dvec3(0.1, 0.2, 0.3), 0.5, {0.3, 0.6});
  CHECK(dark.pdf == 0.0);
}

TEST_CASE("samples in the cone end on the sphere, rim and all", "[shading]") {
  WorstCase worst;
  for (const double distance : {1.00002, 1.1, 3.0, 1e3, 1e8}) {
    const dvec3 from = lamp_center + distance * radius * glm::normalize(dvec3(0.2, -1, 0.4));
    const auto cone = sphere_cone(from, lamp_center, radius);
    REQUIRE(cone);
    for (int i = 0; i <= 64; ++i) {
      const SphereCone::Sample sample = cone->sample({i / 64.0, i * 0.618 - std::floor(i * 0.618)});
      const double off = glm::length(from + sample.distance * sample.direction - lamp_center) / radius - 1.0;
      // Rounding of coordinates at that distance, eight ulps; at the rim the way's rounding counts once more.
      worst.add(std::abs(off), 8.0 * 0x1p-52 * distance * (i == 64 ? 4.0 : 1.0),
                [&] { return fmt::format("{} radii, sample {}: {}", distance, i, off); });
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("light samples and scattered rays share a sphere lamp without loss", "[shading]") {
  // Paper under the lamp, seen along z at the point straight below its centre: albedo L (R / d)^2.
  const std::string paper = R"(, { "type": "bezier", "material": "paper", "patches": [ { "degree": [1, 1],
    "net": [ [ [-9, -9, 0, 1], [-9, 9, 0, 1] ], [ [9, -9, 0, 1], [9, 9, 0, 1] ] ] } ] })";
  std::string text = sphere_lamp_scene(paper);
  text.insert(1,
              R"( "camera": { "type": "orthographic", "origin": [0.5, -0.25, 0.2], "target": [0.5, -0.25, 0],
    "up": [0, 1, 0], "height": 1e-6 }, "film": { "resolution": [8, 8] }, "sampling": { "spp": 256 },)");
  for (const char* integrator : {"direct", "path"}) {
    SceneOverrides overrides;
    overrides.integrator = integrator;
    const Estimate e = picture_mean(StagedScene(text, overrides).render());
    const double exact = 0.5 * 2.0 * radius * radius;
    INFO(integrator << ": " << e.mean << " +- " << e.error << ", " << exact);
    CHECK(std::abs(e.mean - exact) < 5.0 * e.error);
    CHECK(e.error < 0.005 * exact);
  }
}

}  // namespace
}  // namespace rondure
