#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/plugin/builtin.h"
#include "renderer/scene/object_reader.h"
#include "renderer/scene/scene_reader.h"
#include "renderer/scene/transform_reader.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

constexpr double ulp = 0x1p-52;

Surface surface_of(const std::string& object) {
  Registry registry;
  register_builtins(registry);
  Scene scene = read_scene_text("s.json", "{ \"objects\": [" + object + "] }", registry);
  return scene.objects[0].traced.surface;
}

const std::string cube = "\"type\": \"sphere_tiling\"";

bool same_nets(const Surface& a, const Surface& b) {
  if (a.patches.size() != b.patches.size()) return false;
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    if (points_of(a.patches[i]) != points_of(b.patches[i])) return false;
  }
  return true;
}

// The largest difference of any column's length from `length`, of every control point from the plain tiling's
// under the column map of `expected`.
double furthest(const Surface& placed, const dmat4& expected) {
  const Surface plain = surface_of("{" + cube + "}");
  double worst = 0.0;
  for (std::size_t i = 0; i < plain.patches.size(); ++i) {
    const auto& before = points_of(plain.patches[i]);
    const auto& after = points_of(placed.patches[i]);
    for (std::size_t k = 0; k < before.size(); ++k) {
      const dvec4 wanted = expected * before[k];
      const dvec4 found = dvec4(dvec3(after[k]) + placed.origin * after[k].w, after[k].w);
      for (int c = 0; c < 4; ++c)
        worst = std::fmax(worst, std::fabs(found[c] - wanted[c]) / (1.0 + std::fabs(wanted[c])));
    }
  }
  return worst;
}

TEST_CASE("moving a surface leaves every control point's bits alone", "[scene]") {
  const Surface plain = surface_of("{" + cube + "}");
  CHECK(plain.origin == dvec3(0));
  const Surface centred = surface_of("{" + cube + ", \"center\": [1e6, 0.1, -3]}");
  CHECK(same_nets(plain, centred));
  CHECK(centred.origin == dvec3(1e6, 0.1, -3));
  const Surface moved = surface_of("{" + cube +
                                   ", \"center\": [1, 2, 3], \"transform\": [{\"translate\": [0.5, 0, 0]}, "
                                   "{\"translate\": [0, 0, 1e-3]}]}");
  CHECK(same_nets(plain, moved));
  CHECK(moved.origin == dvec3(1.5, 2, 3 + 1e-3));
  const Surface matrix =
      surface_of("{" + cube + ", \"transform\": [[2,0,0,8],[0,2,0,6],[0,0,2,4],[0,0,0,2]]}");
  CHECK(same_nets(plain, matrix));  // divided by its last element
  CHECK(matrix.origin == dvec3(4, 3, 2));
}

TEST_CASE("radius, then centre, then the transform's steps in order", "[scene]") {
  const Surface placed =
      surface_of("{" + cube +
                 ", \"radius\": 2, \"center\": [1, 0, 0], \"transform\": [{\"scale\": [1, 3, 1]}, "
                 "{\"rotate\": {\"axis\": [0, 0, 5], \"angle\": 90}}, {\"translate\": [0, 0, 7]}]}");
  // (x, y, z) -> 2p + (1, 0, 0) -> y times 3 -> (-y, x, z) -> z + 7
  CHECK(placed.origin == dvec3(0, 1, 7));
  const dmat4 expected(0, 2, 0, 0, -6, 0, 0, 0, 0, 0, 2, 0, 0, 1, 7, 1);
  CHECK(furthest(placed, expected) ==
        0.0);  // products with 2 and 6, added to zeros: one rounding, the same in both
}

TEST_CASE("a matrix is read by rows", "[scene]") {
  const Surface placed =
      surface_of("{" + cube + ", \"transform\": [[1,2,0,5],[0,1,0,6],[0,0,4,7],[0,0,0,1]]}");
  const dmat4 expected(1, 0, 0, 0, 2, 1, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1);
  CHECK(placed.origin == dvec3(5, 6, 7));
  CHECK(furthest(placed, expected) <= 4 * ulp);  // origin * w is added here, not there
}

TEST_CASE("the analytic sphere takes the linear part", "[scene]") {
  const Surface placed = surface_of(
      "{\"type\": \"sphere\", \"radius\": 3, \"center\": [1, 2, 3], \"transform\": [{\"scale\": [1, 2, "
      "4]}]}");
  REQUIRE(placed.ellipsoid);
  CHECK(*placed.ellipsoid == dmat3(3, 0, 0, 0, 6, 0, 0, 0, 12));
  CHECK(placed.origin == dvec3(1, 4, 12));
}

TEST_CASE("normals point outward after a reflection", "[scene]") {
  for (const char* transform : {"[{\"scale\": [-1, 1, 1]}]", "[{\"scale\": -2}]",
                                "[{\"scale\": [1, -2, -3]}]", "[[0,1,0,0],[1,0,0,0],[0,0,1,0],[0,0,0.25,2]]",
                                "[[0,-1,0,0],[-1,0,0,0],[0,0,-1,0],[0,0,-0.25,-2]]"}) {
    CAPTURE(transform);
    for (const char* type : {"sphere_tiling", "sphere_octant"}) {
      const Surface surface =
          surface_of(fmt::format("{{\"type\": \"{}\", \"transform\": {}}}", type, transform));
      int inward = 0;
      for (const Net& net : surface.patches) {
        const SurfaceJet p = surface_jet(net, 0.4, 0.35);
        // Images of the unit ball that are convex and hold their origin.
        if (!(glm::dot(glm::cross(p.du, p.dv), p.point) > 0.0)) ++inward;
        for (const dvec4& point : points_of(net)) inward += point.w < 0.0;
      }
      CHECK(inward == 0);
    }
  }
}

TEST_CASE("a net whose corner has a negative weight is negated as a whole", "[scene]") {
  const auto square = [](const char* net, const char* transform) {
    return surface_of(fmt::format(R"({{"type": "bezier", "transform": {}, "patches": [{{"kind": "tensor",
                                      "degree": [1, 1], "net": {}}}]}})",
                                  transform, net));
  };
  const char* net = "[[[0,0,0,-1],[0,-1,0,-2]],[[-1,0,0,-1],[1,1,0,0.5]]]";
  const char* negated = "[[[0,0,0,1],[0,1,0,2]],[[1,0,0,1],[-1,-1,0,-0.5]]]";
  for (const char* transform :
       {"[]", "[{\"scale\": [1, 2, 3]}]", "[[1,0,0,3],[0,2,0,0],[0,0,1,4],[0.25,0,0,1]]"}) {
    CAPTURE(transform);
    const Surface surface = square(net, transform);
    CHECK(points_of(surface.patches[0]).front().w == 1.0);
    CHECK(same_nets(surface, square(negated, transform)));
  }
}

TEST_CASE("a projective transform maps the points that it should", "[scene]") {
  const Surface plain = surface_of("{" + cube + "}");
  const Surface placed = surface_of("{" + cube +
                                    ", \"radius\": 0.5, \"center\": [0.25, 0, 1], \"transform\": "
                                    "[[1,0,0.5,3],[0,2,0,-1],[0,0,1,4],[0.25,0.125,0,1]]}");
  WorstCase worst;
  for (std::size_t i = 0; i < plain.patches.size(); ++i) {
    for (int k = 0; k <= 100; ++k) {
      const double u = (k % 11) / 10.0, v = (k / 11) / 9.2;
      const dvec3 p = 0.5 * net_point(plain.patches[i], u, v) + dvec3(0.25, 0, 1);
      const double w = 0.25 * p.x + 0.125 * p.y + 1;
      const dvec3 wanted = dvec3(p.x + 0.5 * p.z + 3, 2 * p.y - 1, p.z + 4) / w;
      const dvec3 found = net_point(placed.patches[i], u, v) + placed.origin;
      // Sums of 25 terms twice over and the map: some tens of roundings of numbers below 8.
      worst.add(glm::length(found - wanted), 64 * ulp * 8,
                [&] { return fmt::format("patch {} at ({}, {})", i, u, v); });
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(worst.count() == 6 * 101);
}

TEST_CASE("rotations are as orthogonal as doubles can be", "[scene]") {
  for (int k = -8; k <= 8; ++k) {
    const dmat3 m = rotation(dvec3(0, 0, 2), 90.0 * k);
    const double c[] = {1, 0, -1, 0}, s[] = {0, 1, 0, -1};
    const int q = ((k % 4) + 4) % 4;
    CAPTURE(k);
    CHECK(m == dmat3(c[q], s[q], 0, -s[q], c[q], 0, 0, 0, 1));
  }
  CHECK(rotation(dvec3(1, 0, 0), 90)[1] == dvec3(0, 0, 1));
  CHECK(rotation(dvec3(0, 1, 0), 90)[2] == dvec3(1, 0, 0));
  CHECK(rotation(dvec3(1e-200, 0, 0), 90)[1] == dvec3(0, 0, 1));
  CHECK(rotation(dvec3(0, 0, 1), 30)[0].y == 0.5);
  WorstCase worst;
  for (int k = 1; k < 500; ++k) {
    const dvec3 axis(std::sin(k * 1.1), std::sin(k * 2.3), std::sin(k * 3.7));
    const dmat3 m = rotation(axis, k * 7.3);
    const dmat3 gram = glm::transpose(m) * m;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        // Entries rounded once, half an ulp each, six of them in a dot product, and the product's own
        // roundings.
        worst.add(std::fabs(gram[i][j] - (i == j)), 4 * ulp, [&] { return fmt::format("axis {}", k); });
      }
    }
    const dvec3 unit = glm::normalize(axis);
    worst.add(glm::length(m * unit - unit), 4 * ulp, [&] { return fmt::format("fixed axis {}", k); });
    // The angle and its sense, by a vector across the axis.
    const dvec3 across = glm::normalize(glm::cross(unit, dvec3(0.3, 0.2, 0.7)));
    const double angle =
        std::atan2(glm::dot(glm::cross(across, m * across), unit), glm::dot(across, m * across));
    const double turns = (angle * 180 / 3.14159265358979323846 - k * 7.3) / 360;
    worst.add(std::fabs(turns - std::round(turns)), 16 * ulp * (1 + k * 7.3 / 360),
              [&] { return fmt::format("angle {}", k); });
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("thin and tiny transforms are not singular", "[scene]") {
  CHECK(surface_of("{" + cube + ", \"transform\": [{\"scale\": [1, 1, 1e-12]}]}").patches.size() == 6);
  CHECK(surface_of("{" + cube + ", \"transform\": [[1e-200,0,0,0],[0,1e-200,0,0],[0,0,1e-200,0],[0,0,0,1]]}")
            .patches.size() == 6);
  CHECK(surface_of("{" + cube + ", \"transform\": [[1e90,0,0,0],[0,1e90,0,0],[0,0,1e90,0],[0,0,0,1]]}")
            .patches.size() == 6);
}

}  // namespace
}  // namespace rondure
