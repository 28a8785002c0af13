#include "renderer/shading/curvature_colors.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/shading/material.h"
#include "tests/catch.h"
#include "tests/render/staged_scene.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

namespace {

using Kind = CurvatureColors::Kind;
constexpr int color_grid = 9;

// The end and middle colours, as documented, mixed by the share of the range.
const dvec3 blue(0.02, 0.1, 0.55), grey(0.8), red(0.6, 0.03, 0.03);
dvec3 expected(double value, double low, double high) {
  const double t = std::fmin(std::fmax((value - low) / (high - low), 0.0), 1.0);
  return t < 0.5 ? (1.0 - 2.0 * t) * blue + 2.0 * t * grey : (2.0 - 2.0 * t) * grey + (2.0 * t - 1.0) * red;
}

Net bilinear(const dvec3& p00, const dvec3& p01, const dvec3& p10, const dvec3& p11) {
  TensorNet net(1, 1);
  net.points = {dvec4(p00, 1.0), dvec4(p01, 1.0), dvec4(p10, 1.0), dvec4(p11, 1.0)};
  return net;
}

double difference(const dvec3& a, const dvec3& b) {
  const dvec3 d = glm::abs(a - b);
  return std::fmax(d.x, std::fmax(d.y, d.z));
}

}  // namespace

TEST_CASE("diverging colours run from blue over grey to red", "[shading]") {
  CHECK(diverging_color(0.0) == blue);
  CHECK(diverging_color(-INFINITY) == blue);
  CHECK(diverging_color(0.5) == grey);
  CHECK(diverging_color(1.0) == red);
  CHECK(diverging_color(7.0) == red);
  // Halves are exact up to one rounding of each term.
  CHECK(difference(diverging_color(0.25), 0.5 * (blue + grey)) < 1e-15);
  CHECK(difference(diverging_color(0.75), 0.5 * (red + grey)) < 1e-15);
}

// z = x y over the square [-1, 1]^2 by its net: with g = 1 + x^2 + y^2, Gaussian curvature is -1 / g^2 and
// mean curvature -x y / g^(3/2) (do Carmo 1976, section 3-3, for a graph with its normal upward). Both are
// about 1 in size and computed to some 100 ulps; colours vary by less than 2 a unit of curvature over these
// ranges.
TEST_CASE("a saddle has the colours of its curvature", "[shading]") {
  const Net saddle = bilinear({-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}, {1, 1, 1});
  const CurvatureColors gaussian{Kind::gaussian, -1.0, 0.0}, mean{Kind::mean, -0.2, 0.3};
  double worst = 0.0;
  for (int i = 0; i < color_grid; ++i) {
    for (int j = 0; j < color_grid; ++j) {
      const double u = i / (color_grid - 1.0), v = j / (color_grid - 1.0), x = 2.0 * u - 1.0,
                   y = 2.0 * v - 1.0;
      const double g = 1.0 + x * x + y * y;
      worst = std::fmax(worst, difference(curvature_color(gaussian, saddle, u, v, dvec3(0.0)),
                                          expected(-1.0 / (g * g), -1.0, 0.0)));
      worst = std::fmax(worst, difference(curvature_color(mean, saddle, u, v, dvec3(0.0)),
                                          expected(-x * y / std::pow(g, 1.5), -0.2, 0.3)));
    }
  }
  INFO("worst difference " << worst);
  CHECK(worst < 1e-12);
}

TEST_CASE("a plane is grey, and a range as wide or narrow as doubles are still has its colours",
          "[shading]") {
  const Net plane = bilinear({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0});
  CHECK(curvature_color({Kind::mean, -1.0, 1.0}, plane, 0.3, 0.6, dvec3(0.0)) == grey);
  CHECK(curvature_color({Kind::gaussian, -1.7e308, 1.7e308}, plane, 0.3, 0.6, dvec3(0.0)) == grey);
  CHECK(curvature_color({Kind::mean, -5e-324, 5e-324}, plane, 0.3, 0.6, dvec3(0.0)) == grey);
  CHECK(curvature_color({Kind::mean, 0.0, 5e-324}, plane, 0.3, 0.6, dvec3(0.0)) == diverging_color(0.0));
}

TEST_CASE("where a patch has no curvature, its own albedo stays", "[shading]") {
  const Net point = bilinear({0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  CHECK(curvature_color({}, point, 0.5, 0.5, dvec3(0.1, 0.2, 0.3)) == dvec3(0.1, 0.2, 0.3));
}

// A sphere of radius 2 has Gaussian curvature 1/4 and mean curvature -1/2 wherever it is hit, on a mirror
// image too, whose normals still point outward. Curvature is good to some 100 ulps on the cube's tiling,
// whose corners are regular, and colours move by less than 2 a unit.
TEST_CASE("a scene's sphere has one colour, an isoline its ink", "[shading]") {
  for (const char* transform : {"{ \"scale\": 1 }", "{ \"scale\": [1, 1, -1] }"}) {
    for (const Kind kind : {Kind::gaussian, Kind::mean}) {
      const bool mean = kind == Kind::mean;
      const auto material_at = [&](const std::string& isolines, const dvec3& toward) {
        const StagedScene staged(fmt::format(R"({{ "materials": {{ "m": {{ "albedo": 0.3, {}
            "curvature": {{ "of": "{}", "range": [-1, 1] }} }} }},
            "objects": [ {{ "type": "sphere_tiling", "topology": "cube", "radius": 2, "material": "m",
                            "transform": [ {} ] }} ] }})",
                                             isolines, mean ? "mean" : "gaussian", transform));
        const Hit hit = staged.world.tracer().closest(Ray{5.0 * toward, -toward});
        REQUIRE(hit);
        return std::get<Diffuse>(staged.world.material(hit).scattering).albedo;
      };
      double worst = 0.0;
      for (const dvec3& way :
           {dvec3(1, 0.2, 0.3), dvec3(-0.4, 1, 0.1), dvec3(0.1, 0.2, -1), dvec3(1, 1, 1.01)}) {
        const dvec3 seen = material_at("", glm::normalize(way));
        worst = std::fmax(worst, difference(seen, expected(mean ? -0.5 : 0.25, -1.0, 1.0)));
      }
      INFO("worst difference " << worst << " under " << transform);
      CHECK(worst < 1e-12);
      CHECK(material_at(R"("isolines": { "count": 1, "boundary_width": 9, "albedo": 0.07 },)",
                        glm::normalize(dvec3(1, 0.2, 0.3))) == dvec3(0.07));
    }
  }
}
