// Quadrilaterals and triangles of circular arcs as scenes ask for them.
#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "renderer/bezier/rational.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using Big = boost::multiprecision::cpp_bin_float_50;
using nlohmann::json;

const std::string cube = R"("corners": [[-1,-1,-1],[-1,1,-1],[1,1,-1],[1,-1,-1]])";
const std::string octant = R"("corners": [[1,0,0],[0,1,0],[0,0,1]])";

// Between the parallels and meridians of a globe: four right angles.
const std::string latlong = R"("corners": [[0,-1,-0.5],[0.8,-0.6,-0.5],[0.8,-0.6,0.5],[0,-1,0.5]],
    "arcs": [{"plane": [0,0,1,-0.44721359549995794]}, null, {"plane": [0,0,1,0.44721359549995794]}, null])";

Surface quad(const std::string& rest) { return build_family(R"({"type": "circular_quad", )" + rest + "}"); }

json dhj_entry(const std::string& name) {
  std::ifstream file(source_folder() + "/tests/data/dhj_nets.json");
  for (const json& entry : json::parse(file)) {
    if (entry["name"] == name) return entry;
  }
  return {};
}

}  // namespace

TEST_CASE("patches of degree (2, 4) have the reference's nets", "[surfaces]") {
  WorstCase worst;
  const std::pair<const char*, const char*> cases[] = {{"24_cube_face", "circular_cube_face"},
                                                       {"24_icosa_rhombus", "circular_icosahedron_pair"},
                                                       {"24_small_circles", "circular_small_circles"},
                                                       {"24_cube_face", "tiling_cube_2_4"}};
  for (const auto& [name, object] : cases) {
    // Corners and arcs in doubles stand with the ray cases.
    std::ifstream file(source_folder() + "/tests/data/rays/" + object + ".json");
    const Surface surface = build_family(json::parse(file)["object"].dump());
    const auto& net = std::get<TensorNet>(surface.patches.at(0));
    REQUIRE((net.m == 2 && net.n == 4));
    const json expected = dhj_entry(name)["net"];
    for (int i = 0; i <= 2; ++i) {
      for (int j = 0; j <= 4; ++j) {
        for (int d = 0; d < 4; ++d) {
          const Big exact(expected[i][j][d].get<std::string>());
          // The corners are rounded to doubles, some 2^-53; control points follow with factors of a few.
          worst.add(static_cast<double>(abs(exact - Big(net.at(i, j)[d]))), 8.0 * 0x1p-53,
                    [&, n = name] { return fmt::format("{} ({}, {}) {}", n, i, j, d); });
        }
      }
    }
  }
  INFO(worst.text());
  CHECK(worst.count() == 4 * 60);
  CHECK(worst.failures() == 0);
}

TEST_CASE("auto takes the lowest degree that is regular", "[surfaces]") {
  const auto degree = [](const Surface& surface) {
    const auto& net = std::get<TensorNet>(surface.patches.at(0));
    return std::pair(net.m, net.n);
  };
  CHECK(degree(quad(latlong)) == std::pair(2, 2));
  CHECK(degree(quad(latlong + R"(, "construction": "biquadratic", "shape": 3)")) == std::pair(2, 2));
  CHECK(degree(quad(latlong + R"(, "construction": "degree_2_4")")) == std::pair(2, 4));
  CHECK(degree(quad(cube)) == std::pair(2, 4));
  CHECK(degree(quad(cube + R"(, "quartic": "u")")) == std::pair(4, 2));
  const auto triangle = [](const std::string& rest) {
    const Surface s = build_family(R"({"type": "circular_triangle", )" + rest + "}");
    return std::get<TriangleNet>(s.patches.at(0)).n;
  };
  CHECK(triangle(octant) == 4);
  // Circles through the north pole: straight in the plane, 180 degrees in all.
  CHECK(triangle(R"("corners": [[0.8,0,-0.6],[-0.6666666666666666,-0.6666666666666666,-0.3333333333333333],
      [-0.6666666666666666,0.6666666666666666,-0.3333333333333333]], "arcs": [
      {"plane": [2, -4, 1, 1]}, {"plane": [1, 0, -0.5, -0.5]}, {"plane": [2, 4, 1, 1]}])") == 2);
}

TEST_CASE("weights are positive where they can be", "[surfaces]") {
  int negative = 0;
  for (const std::string& text :
       {R"({"type": "circular_quad", )" + latlong + "}", R"({"type": "circular_quad", )" + cube + "}",
        R"({"type": "circular_triangle", )" + octant + "}"}) {
    const Surface surface = build_family(text);
    for (const dvec4& p : points_of(surface.patches.at(0))) negative += !(p.w > 0.0);
  }
  CHECK(negative == 0);
}

TEST_CASE("the octant is a triangle without a singular corner", "[surfaces]") {
  const Surface surface = build_family(R"({"type": "circular_triangle", )" + octant + "}");
  NetMaker make(51);
  WorstCase worst;
  for (int k = 0; k < 300; ++k) {
    dvec2 at = make.in_triangle();
    if (k % 4 == 0) at.x = 0.0;
    if (k % 7 == 0) at = {double(k % 2), double((k + 1) % 2)};
    const SurfaceJet jet = surface_jet(surface.patches[0], at.x, at.y);
    const auto text = [&] { return fmt::format("({}, {})", at.x, at.y); };
    worst.add(std::abs(glm::length(jet.point) - 1.0), 8 * 0x1p-52, text);
    const dvec3 normal = glm::cross(jet.du, jet.dv);
    worst.add(glm::length(normal / glm::length(normal) - jet.point), 1e-13, text);
    CHECK(glm::length(normal) > 0.1);
    CHECK(std::min({jet.point.x, jet.point.y, jet.point.z}) > -1e-15);
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("arcs without the patch asked for say why", "[surfaces]") {
  const auto refused = [](const std::string& text, const std::string& part) {
    const std::string message = family_error(text);
    INFO(text << "\n" << message);
    CHECK(message.find(part) != std::string::npos);
  };
  const std::string q = R"({"type": "circular_quad", )", t = R"({"type": "circular_triangle", )";
  // Angles of 120 degrees, and of 90.
  refused(q + cube + R"(, "construction": "biquadratic"})", "exceed that by 120 degrees");
  refused(t + octant + R"(, "construction": "quadratic"})", "exceed that by 90 degrees");
  // The longer way round one of the circles closes with the other sign only.
  refused(q + R"("corners": [[0,-1,-0.5],[0.8,-0.6,-0.5],[0.8,-0.6,0.5],[0,-1,0.5]], "arcs": [
      {"through": [0,1,-0.5]}, null, {"plane": [0,0,1,0.44721359549995794]}, null],
      "construction": "biquadratic"})",
          "take the other arc of one circle");
  refused(q + R"("corners": [[-1,-1,-1],[1,-1,-1],[1,1,-1],[-1,1,-1]]})", "these run clockwise");
  refused(t + R"("corners": [[1,0,0],[0,0,1],[0,1,0]]})", "these run clockwise");
  // On one great circle, there and back.
  refused(t + R"("corners": [[1,0,0],[0,1,0],[1,1,0]]})", "enclose no area");
  refused(t + R"("corners": [[3,1,2],[1,5,1],[4,6,3]]})", "enclose no area");
  refused(q + R"("corners": [[1,0,0],[1,1,0],[0,1,0],[1,2,0]]})", "enclose no area");
  refused(q + cube + R"(, "arcs": [{"thruogh": [-1,0,-1]}, null, null, null]})", "did you mean \"through\"");
  // Crosses itself.
  refused(q + R"("corners": [[-1,-1,-1],[1,1,-1],[-1,1,-1],[1,-1,-1]]})", "folds, near (u, v)");
  refused(q + R"("corners": [[-1,-1,-1],[-1,1,-1],[1,1,-1]]})", "an array of four directions");
  refused(t + R"("corners": [[1,0,0],[0,1,0],[0,0,1],[1,1,1]]})", "an array of three directions");
  refused(t + R"("corners": [[1,0,0],[0,1,0],[0,0,1]], "arcs": [null, null]})", "an array of three arcs");
  refused(t + R"("corners": [[1,0,0],[-1,0,0],[0,0,1]]})", "corners[0] and corners[1] are opposite");
  refused(t + R"("corners": [[1,0,0],[0,1,0],[1,0,0]]})", "corners[2] and corners[0] are the same");
}

// Every corner is straight there, at 180 degrees, and the holonomy -1 but for rounding, which decides which
// root of it is the lesser. The patch covers the side that lies to the left all the same.
TEST_CASE("sides that run round one circle bound the cap on their left", "[surfaces]") {
  NetMaker make(52);
  WorstCase worst;
  int built = 0, wanted = 0;
  for (int k = 0; k < 80; ++k) {
    const int corners = k % 2 == 0 ? 4 : 3;
    const double z = make.uniform(-0.8, 0.8), r = std::sqrt(1 - z * z);
    const bool north = k % 4 < 2;
    const dvec3 axis = glm::normalize(dvec3(make.uniform(-1, 1), make.uniform(-1, 1), make.uniform(0.5, 1)));
    const dvec3 e1 = glm::normalize(glm::cross(axis, dvec3(0.3, -0.2, 0.9))), e2 = glm::cross(axis, e1);
    const auto at = [&](double turn) {
      const dvec3 p = r * std::cos(turn) * e1 + r * std::sin(turn) * e2 + z * axis;
      return fmt::format("[{}, {}, {}]", p.x, p.y, p.z);
    };
    std::vector<double> turns{make.uniform(0, 6)};
    for (int c = 1; c <= corners; ++c)
      turns.push_back(turns[0] + (north ? 1 : -1) * 6.283185307179586 *
                                     (c + (c < corners ? make.uniform(-0.3, 0.3) : 0)) / corners);
    std::string points, arcs;
    for (std::size_t c = 0; c + 1 < turns.size(); ++c) {
      points += (c > 0 ? ", " : "") + at(turns[c]);
      arcs += (c > 0 ? ", " : "") + fmt::format(R"({{"through": {}}})", at(0.5 * (turns[c] + turns[c + 1])));
    }
    ++wanted;
    const std::string text = fmt::format(R"({{"type": "circular_{}", "corners": [{}], "arcs": [{}]}})",
                                         corners == 4 ? "quad" : "triangle", points, arcs);
    INFO(text);
    const Surface surface = build_family(text);
    ++built;
    const Net& net = surface.patches.at(0);
    // The cap's area: the integrand is analytic, though shapes that are found may crowd the lines. The other
    // side's is off by at least 2 z 2 pi, unless the circle is nearly a great one.
    using Gauss = boost::math::quadrature::gauss<double, 40>;
    const double area = Gauss::integrate(
        [&](double u) {
          const double width = corners == 4 ? 1.0 : 1.0 - u;
          return width * Gauss::integrate(
                             [&](double t) {
                               const SurfaceJet jet = surface_jet(net, u, t * width);
                               return glm::dot(jet.point, glm::cross(jet.du, jet.dv));
                             },
                             0.0, 1.0);
        },
        0.0, 1.0);
    worst.add(std::abs(area - 6.283185307179586 * (north ? 1 - z : 1 + z)), 0.001, [&] { return text; });
  }
  INFO(worst.text());
  CHECK(built == wanted);
  CHECK(worst.failures() == 0);
  const std::string circle = R"("corners": [[1,0,0.2],[0,1,0.2],[-1,0,0.2],[0,-1,0.2]], "arcs": [
      {"through": [1,1,0.2828427124746190]}, {"through": [-1,1,0.2828427124746190]},
      {"through": [-1,-1,0.2828427124746190]}, {"through": [1,-1,0.2828427124746190]}])";
  CHECK(family_error(R"({"type": "circular_quad", )" + circle + R"(, "construction": "biquadratic"})")
            .find("here all four are 180 degrees") != std::string::npos);
}

// A cap of `away` radians about the pole between four arcs of 90 degrees.
namespace {

std::string cap_corners(double away) {
  const double r = std::sin(away), z = std::cos(away), h = r * std::sqrt(0.5);
  return fmt::format(
      R"("corners": [[{0}, 0, {1}], [0, {0}, {1}], [-{0}, 0, {1}], [0, -{0}, {1}]], "arcs": [
         {{"through": [{2}, {2}, {1}]}}, {{"through": [-{2}, {2}, {1}]}},
         {{"through": [-{2}, -{2}, {1}]}}, {{"through": [{2}, -{2}, {1}]}}])",
      r, z, h);
}

double note(const Surface& surface, const std::string& name) {
  for (const Note& n : surface.notes) {
    if (n.name == name) return n.value;
  }
  return NAN;
}

int negative_weights(const Surface& surface) {
  const std::vector<dvec4>& points = points_of(surface.patches.at(0));
  return static_cast<int>(
      std::count_if(points.begin(), points.end(), [](const dvec4& p) { return !(p.w > 0.0); }));
}

}  // namespace

TEST_CASE("a shape of positive weights is sought where the even one has none", "[surfaces]") {
  // A cap of 80 degrees has them at once; nearly a hemisphere, at another shape; more than it, never.
  const Surface small = quad(cap_corners(1.2)), half = quad(cap_corners(1.5)), large = quad(cap_corners(2.0));
  CHECK(negative_weights(small) == 0);
  CHECK(std::isnan(note(small, "positive_weights")));
  CHECK(negative_weights(half) == 0);
  CHECK(note(half, "positive_weights") == 1.0);
  CHECK(negative_weights(large) > 0);
  CHECK(note(large, "positive_weights") == 0.0);
  CHECK(large.notes.at(0).meaning.find("proved") != std::string::npos);

  // What is told is taken when it is given, to rounding of the degrees.
  const auto& found = std::get<TensorNet>(half.patches.at(0));
  const std::string shape =
      fmt::format(R"(, "quartic": "{}", "shape": [{}, {}, {}, {}])", found.n == 4 ? "v" : "u",
                  note(half, "shape_0"), note(half, "shape_1"), note(half, "shape_2"), note(half, "shape_3"));
  const Surface given = quad(cap_corners(1.5) + shape);
  CHECK(std::isnan(note(given, "positive_weights")));
  const auto& again = std::get<TensorNet>(given.patches.at(0));
  REQUIRE((again.m == found.m && again.n == found.n));
  WorstCase worst;
  for (std::size_t k = 0; k < found.points.size(); ++k)
    worst.add(glm::length(found.points[k] - again.points[k]), 1e-14 * glm::length(found.points[k]),
              [&] { return fmt::format("control point {}", k); });
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("a shape that is given is obeyed", "[surfaces]") {
  // Even where it has weights of both signs, and another has not.
  CHECK(negative_weights(quad(cap_corners(1.5) + R"(, "shape": 1)")) > 0);
  CHECK(negative_weights(quad(cap_corners(1.5) + R"(, "shape": [1, 1, 1, 0])")) > 0);
  const auto corner = [](const Surface& surface) {
    return points_of(surface.patches.at(0)).back().w / points_of(surface.patches.at(0)).front().w;
  };
  // Weights are squares; those at the other corners stay.
  CHECK(corner(quad(cube + R"(, "shape": 3)")) == Approx(9.0));
  CHECK(corner(quad(cube + R"(, "shape": [3, 1, 1, 0])")) == Approx(9.0));
  CHECK(std::get<TensorNet>(quad(latlong + R"(, "shape": [2, 1, 1, 0])").patches.at(0)).n == 4);
  CHECK(std::get<TensorNet>(quad(latlong + R"(, "shape": 2)").patches.at(0)).n == 2);
  const auto refused = [](const std::string& text, const std::string& part) {
    const std::string message = family_error(text);
    INFO(text << "\n" << message);
    CHECK(message.find(part) != std::string::npos);
  };
  const std::string q = R"({"type": "circular_quad", )", t = R"({"type": "circular_triangle", )";
  for (const char* bad : {"0", "-1", "1e7", "[1, 1]", "[1, 1, 1, 400]", "[1, 0, 1, 0]", "\"even\"", "[]",
                          "null", "[1, [1], 1, 0]", "true"})
    refused(q + cube + R"(, "shape": )" + bad + "}", "\"shape\" must be");
  refused(q + cube + R"(, "shape": [1, 1, 1, 170]})", "past 180 degrees");
  refused(q + latlong + R"(, "construction": "biquadratic", "shape": [1, 1, 1, 0]})", "must be one number");
  refused(t + octant + R"(, "shape": [1, 1, 1, 0]})", "an array of 5");
  refused(t + octant + R"(, "construction": "quadratic", "shape": 1})", "no \"shape\"");
}

TEST_CASE("a patch tells the excess of its angles", "[surfaces]") {
  const Surface surface = quad(cube);
  REQUIRE(surface.notes.size() == 1);
  CHECK(surface.notes[0].name == "angle_excess");
  CHECK(surface.notes[0].value == Approx(120.0));
}

}  // namespace rondure
