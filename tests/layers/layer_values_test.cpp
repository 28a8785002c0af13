// What the layers measure, against what is known of a sphere.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "renderer/film/legend_strip.h"
#include "tests/catch.h"
#include "tests/render/staged_scene.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// The planes of a film by channel.
std::map<std::string, const std::vector<float>*> planes(const Film& film) {
  std::map<std::string, const std::vector<float>*> by_name;
  for (const LayerPlane& plane : film.layers) by_name[plane.channel] = &plane.values;
  return by_name;
}

std::string scene_of(const std::string& object, const std::string& layers) {
  return fmt::format(R"({{ "camera": {{ "origin": [2, -6, 3], "fov": 22 }}, "film": {{ "resolution": [48, 48],
    "layers": [ {} ] }}, "objects": [ {} ] }})",
                     layers, object);
}

TEST_CASE("on a sphere errors vanish and curvatures are one", "[layers]") {
  const char* layers =
      R"("normal_error", { "type": "normal_error", "of": "cross_float", "as": "Single" }, "residual",
                          "curvature", "work")";
  for (const char* object : {R"({ "type": "sphere_tiling", "topology": "hemispheres", "radius": 0.5 })",
                             R"({ "type": "sphere_octant", "radius": 0.5, "center": [1, 0, 0] })",
                             R"({ "type": "sphere", "radius": 0.5 })"}) {
    CAPTURE(object);
    const bool analytic = std::string(object).find("\"sphere\"") != std::string::npos;
    const Film film = StagedScene(scene_of(object, layers)).render(1);
    auto plane = planes(film);
    WorstCase worst;
    int hits = 0, single = 0;
    for (std::size_t at = 0; at < film.geometry.size(); ++at) {
      const auto value = [&](const char* name) { return static_cast<double>(plane.at(name)->at(at)); };
      const auto check = [&](const char* name, double expected, double tolerance) {
        worst.add(std::abs(value(name) - expected), tolerance,
                  [&] { return fmt::format("{} is {} at pixel {}", name, value(name), at); });
      };
      if (film.geometry[at].surface < 0) {
        check("NormalError.analytic", 0.0, 1e-30);
        check("Work.solver", 0.0, 1e-30);
        continue;
      }
      ++hits;
      // 1e-12 rad in degrees; points good to some ulps of the coordinates, here below 10.
      check("NormalError.analytic", 0.0, 5.8e-11);
      check("NormalError.limit", 0.0, 5.8e-11);
      check("Residual.implicit", 0.0, 1e-15);
      check("Residual.ray", 0.0, 1e-14);
      check("Curvature.gaussian", 4.0, 1e-5);
      check("Curvature.mean", -2.0, 1e-5);
      check("Curvature.gaussian_error", 0.0, 1e-7);
      check("Curvature.mean_error", 0.0, 1e-7);
      // 1: closed form; 5: quadric, which is the default where a patch lies on a sphere.
      check("Work.solver", analytic ? 1.0 : 5.0, 1e-30);
      single += value("Single.analytic") > 1e-7;
    }
    INFO(worst.text());
    CHECK(worst.failures() == 0);
    CHECK(hits > 200);
    CHECK(single == (analytic ? 0 : hits));
  }
}

TEST_CASE("where no quadric is known errors say so", "[layers]") {
  const Film film = StagedScene(scene_of(R"({ "type": "gc_octahedron", "transform": [ { "scale": 0.05 } ] })",
                                         R"("normal_error", "residual", "curvature")"))
                        .render(1);
  auto plane = planes(film);
  int hits = 0, unknown = 0;
  for (std::size_t at = 0; at < film.geometry.size(); ++at) {
    if (film.geometry[at].surface < 0) continue;
    ++hits;
    for (const char* name :
         {"NormalError.analytic", "Residual.implicit", "Curvature.gaussian_error", "Curvature.mean_error"})
      unknown += plane.at(name)->at(at) == -1.0f;
    unknown += plane.at("NormalError.limit")->at(at) < 1e-13f;
  }
  CHECK(hits > 100);
  CHECK(unknown == 5 * hits);
}

TEST_CASE("lines are where their definitions put them, whatever the patch", "[layers]") {
  const char* layers = R"({ "type": "isophotes", "count": 10, "direction": [0, 0, 2e200] },
    { "type": "reflection_lines", "count": 12, "thickness": 0.25, "direction": [0, 1, 0] },
    { "type": "highlight_lines", "direction": [1e-200, 0, 0] })";
  const StagedScene sphere(scene_of(R"({ "type": "sphere" })", layers));
  const Film truth = sphere.render(1);
  for (const char* object :
       {R"({ "type": "sphere_tiling", "topology": "octahedron_pairs" })", R"({ "type": "sphere_octant" })"}) {
    const Film film = StagedScene(scene_of(object, layers)).render(1);
    auto plane = planes(film), expected = planes(truth);
    WorstCase worst;
    int drawn = 0;
    for (std::size_t at = 0; at < film.geometry.size(); ++at) {
      if (truth.geometry[at].surface < 0) continue;
      for (const auto& [name, values] : plane) {
        // Places are stored as floats below 25.
        worst.add(std::abs(values->at(at) - expected.at(name)->at(at)), name.ends_with("place") ? 4e-6 : 0.5,
                  [&, n = name] { return fmt::format("{} at pixel {}", n, at); });
        if (name.ends_with("line")) drawn += values->at(at) > 0.0f;
      }
      // By hand: the angle of the point's own direction to the z axis, and the reflected ray about the y
      // axis.
      const dvec3 n = glm::normalize(truth.geometry[at].point);
      worst.add(std::abs(plane.at("Isophotes.place")->at(at) - std::acos(n.z) / 3.14159265358979 * 10.0),
                1e-5, [&] { return fmt::format("isophote at pixel {}", at); });
      const dvec3 ray = glm::normalize(truth.geometry[at].point - dvec3(2, -6, 3)),
                  r = ray - 2.0 * glm::dot(ray, n) * n;
      // Equal places a twelfth of a turn apart, from wherever they are counted.
      const double turn = std::atan2(r.x, r.z) / 6.28318530717958 * 12.0;
      const double place = plane.at("ReflectionLines.place")->at(at);
      const double apart =
          std::min(std::abs(std::remainder(place - turn, 3.0)), std::abs(std::remainder(place + turn, 3.0)));
      worst.add(apart, 2e-5,
                [&] { return fmt::format("reflection at pixel {}: {} and {}", at, place, turn); });
    }
    INFO(worst.text());
    CHECK(worst.failures() == 0);
    CHECK(drawn > 300);
  }
}

TEST_CASE("lines of light in a plane are met where the distance of skew lines is zero", "[layers]") {
  const char* layers =
      R"({ "type": "highlight_lines", "count": 5, "thickness": 0.4, "direction": [0.1, 1, 0.2],
      "position": [0.3, 0.1, 2.5], "step": [0.4, 0, 0.1] },
    { "type": "reflection_lines", "count": 4, "thickness": 0.5, "direction": [1, 0.1, 0],
      "position": [0, -1, 3], "step": [0.2, 0.8, 0] })";
  const Film film = StagedScene(scene_of(R"({ "type": "sphere_tiling" })", layers)).render(1);
  auto plane = planes(film);
  WorstCase worst;
  int lines[2] = {0, 0}, none = 0;
  for (std::size_t at = 0; at < film.geometry.size(); ++at) {
    if (film.geometry[at].surface < 0) continue;
    const dvec3 q = film.geometry[at].point, n = glm::normalize(q);
    const dvec3 view = glm::normalize(q - dvec3(2, -6, 3)), mirrored = view - 2.0 * glm::dot(view, n) * n;
    // The distance of line k of light, of direction b through a + k c, from the line through q along d (Beier
    // and Chen 1994, equation 2). It is linear in k, so that two of them tell where it is zero.
    const auto zero = [&](const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
      const auto distance = [&](double k) {
        return glm::dot(glm::cross(b, d), a + k * c - q) / glm::length(glm::cross(b, d));
      };
      return distance(0.0) / (distance(0.0) - distance(1.0));
    };
    const dvec3 c(0.4, 0, 0.1), e(0.2, 0.8, 0);
    const double highlight = zero(dvec3(0.3, 0.1, 2.5) - 2.0 * c, {0.1, 1, 0.2}, c, n);
    double reflection = zero(dvec3(0, -1, 3) - 1.5 * e, {1, 0.1, 0}, e, mirrored);
    // What looks down sees no light.
    if (!(mirrored.z > 0.0)) reflection = -100.0;
    const auto check = [&](double place, int count, double thickness, const std::string& group, int& drawn) {
      const bool among = place > -0.5 * thickness && place < count - 1 + 0.5 * thickness;
      const bool on = among && std::abs(place - std::round(place)) < 0.5 * thickness;
      const bool sure = std::abs(std::abs(place - std::round(place)) - 0.5 * thickness) > 1e-5;
      const double shown = plane.at(group + ".place")->at(at);
      if (among && sure)
        worst.add(std::abs(shown - place), 1e-6,
                  [&] { return fmt::format("{} at pixel {}: {} and {}", group, at, shown, place); });
      if (sure)
        worst.add(plane.at(group + ".line")->at(at) == (on ? 1.0f : 0.0f) ? 0.0 : 1.0, 0.5,
                  [&] { return fmt::format("{} at pixel {}: place {}", group, at, place); });
      drawn += on;
      none += !among;
    };
    check(highlight, 5, 0.4, "HighlightLines", lines[0]);
    check(reflection, 4, 0.5, "ReflectionLines", lines[1]);
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(lines[0] > 30);
  CHECK(lines[1] > 30);
  CHECK(none > 100);
}

TEST_CASE("the study integrator shows a channel by its colours, and a legend", "[layers]") {
  const char* scene = R"({ "film": { "resolution": [60, 40] }, "sampling": { "spp": 1 },
    "integrator": { "type": "study", "layer": "curvature", "channel": "mean", "range": [-3, -1], "colors": "grey" },
    "objects": [ { "type": "sphere" } ] })";
  const StagedScene s(scene);
  const Film film = s.render();
  int shown = 0, black = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 60; ++x) {
      // -1 is the bright end, white in linear light. The curvature there is rounded in some places, by 4 ulps
      // at most, and the colour by three times as much.
      shown += glm::distance(film.mean(x, y).color, dvec3(1.0)) < 3.0 * 4.0 * 0x1p-52;
      black += film.mean(x, y).color == dvec3(0.0);
    }
  }
  CHECK(shown + black == 2400);
  CHECK(shown > 300);
  const std::optional<Legend> legend = s.scene.integrator->legend();
  REQUIRE(legend);
  CHECK(legend->title == "Curvature.mean (1/length)");
  CHECK(legend->colors.size() == 256);
  std::vector<unsigned char> strip(3 * 60 * 40, 7);
  const int height = append_legend(strip, 60, 40, *legend);
  CHECK(height > 70);
  REQUIRE(strip.size() == static_cast<std::size_t>(3 * 60 * height));
  CHECK(std::count(strip.begin(), strip.begin() + 3 * 60 * 40, 7) == 3 * 60 * 40);
  // The bar runs from black to white, and there is text.
  CHECK(std::count(strip.begin() + 3 * 60 * 40, strip.end(), 255) > 50);
  Legend log{"", 1e-12, 10.0, true, {}};
  CHECK(legend_ticks(log, 4) == std::vector<double>{1e-12, 1e-8, 1e-4, 1.0});
  CHECK(legend_ticks(*legend, 3) == std::vector<double>{-3.0, -2.0, -1.0});
}

}  // namespace
}  // namespace rondure
