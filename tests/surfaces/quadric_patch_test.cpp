// Patches of quadrics as scenes ask for them: on the quadric, within their sides, and met by rays where the
// quadric's equation says.
#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/tracer.h"
#include "renderer/projective/quadric.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"
#include "tests/surfaces/quadric_roots.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

struct QuadricCase {
  const char* parameters;
  Quadric quadric;
  std::size_t patches;
  bool closed = false;
};

Quadric plain_quadric(QuadricKind kind, const lvec3& axes) { return {kind, axes, lmat4(1)}; }

// z = x y.
const Quadric saddle{QuadricKind::hyperbolic_paraboloid,
                     {std::sqrt(2.0L), std::sqrt(2.0L), 1},
                     {{std::sqrt(0.5L), std::sqrt(0.5L), 0, 0},
                      {-std::sqrt(0.5L), std::sqrt(0.5L), 0, 0},
                      {0, 0, 1, 0},
                      {0, 0, 0, 1}}};

const QuadricCase quadric_cases[] = {
    {R"("semi_axes": [2, 1, 0.5], "surface": {"type": "sphere_tiling", "topology": "cube_2_4"})",
     plain_quadric(QuadricKind::ellipsoid, {2, 1, 0.5L}), 6, true},
    {R"("matrix": [[1,0,0,-1],[0,4,0,0],[0,0,9,0],[-1,0,0,-3]], "surface": {"type": "sphere_octant"})",
     {QuadricKind::ellipsoid, {2, 1, 2 / 3.0L}, {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 1}}},
     8,
     true},
    {R"("quadric": "two_sheets", "semi_axes": [1, 2, 0.5], "surface": {"type": "sphere_cap", "z_max": -0.4})",
     plain_quadric(QuadricKind::two_sheets, {1, 2, 0.5L}), 1},
    {R"("quadric": "two_sheets", "surface": {"type": "circular_quad",
         "corners": [[-1,-1,-2],[-1,1,-2],[1,1,-2],[1,-1,-2]]})",
     plain_quadric(QuadricKind::two_sheets, {1, 1, 1}), 1},
    {R"("quadric": "elliptic_paraboloid", "semi_axes": [1, 2, 3], "surface": {"type": "sphere_cap", "z_max": 0.2})",
     plain_quadric(QuadricKind::elliptic_paraboloid, {1, 2, 3}), 1},
    {R"("quadric": "elliptic_paraboloid", "surface": {"type": "circular_triangle",
         "corners": [[1,0,-1],[-1,-1,-1],[-1,1,-1]]})",
     plain_quadric(QuadricKind::elliptic_paraboloid, {1, 1, 1}), 1},
    {R"("quadric": "one_sheet", "semi_axes": [1, 2, 0.5], "rulings": [[-30, 40], [-20, 35]])",
     plain_quadric(QuadricKind::one_sheet, {1, 2, 0.5L}), 1},
    // Between two parallels.
    {R"("quadric": "one_sheet", "preimage": [{"degree": [1, 1], "net": [
         [[1,0,0.5,0.8660254],[1,0,-0.5,0.8660254]],
         [[0.70710678,0.70710678,0.96592583,0.25881905],[0.70710678,0.70710678,0.25881905,0.96592583]]]}])",
     plain_quadric(QuadricKind::one_sheet, {1, 1, 1}), 1},
    {R"("quadric": "hyperbolic_paraboloid", "semi_axes": [1, 2, 3], "rulings": [[-1, 2], [-2, 1]])",
     plain_quadric(QuadricKind::hyperbolic_paraboloid, {1, 2, 3}), 1},
    {R"("matrix": [[0,1,0,0],[1,0,0,0],[0,0,0,-1],[0,0,-1,0]], "rulings": [[-1, 1], [-1, 1]])", saddle, 1},
    // Two parallels and two meridians; then sides that only degree (2, 4) fits.
    {R"("quadric": "one_sheet", "corners": [[1.25,0,-0.75],[0,1.25,-0.75],[0,1.25,0.75],[1.25,0,0.75]],
         "sections": [{"plane": [0,0,1,-0.75]}, null, {"plane": [0,0,1,0.75]}, null])",
     plain_quadric(QuadricKind::one_sheet, {1, 1, 1}), 1},
    {R"("quadric": "one_sheet", "semi_axes": [2, 2, 2], "corners": [[2.5,0,-1.5],[0,2,0],[0,2.5,1.5],[2.5,0,1.5]])",
     plain_quadric(QuadricKind::one_sheet, {2, 2, 2}), 1},
    {R"("matrix": [[1,0,0,0],[0,-1,0,0],[0,0,0,-0.5],[0,0,-0.5,0]],
         "corners": [[-1,-1,0],[1,-1,0],[1.5,1,1.25],[-1,1,0]], "sections": [null, {"through": [1.25,0.5,1.3125]}, null, null])",
     plain_quadric(QuadricKind::hyperbolic_paraboloid, {1, 1, 1}), 1}};

std::string object(const char* parameters) {
  return fmt::format(R"({{"type": "quadric_patch", {}}})", parameters);
}

double distance_from(const lmat4& matrix, const dvec3& p) {
  const lvec4 x(lvec3(p), 1);
  const lvec4 gradient = matrix * x;
  return static_cast<double>(std::abs(glm::dot(x, gradient)) / (2 * glm::length(lvec3(gradient))));
}

}  // namespace

TEST_CASE("quadric patches lie on their quadric", "[surfaces]") {
  NetMaker make(61);
  WorstCase worst;
  for (const QuadricCase& c : quadric_cases) {
    INFO(c.parameters);
    const Surface surface = build_family(object(c.parameters));
    REQUIRE(surface.patches.size() == c.patches);
    CHECK(surface.closed == c.closed);
    const lmat4 matrix = matrix_of(c.quadric);
    for (int k = 0; k < 200; ++k) {
      const Net& net = surface.patches[static_cast<std::size_t>(k) % surface.patches.size()];
      const bool triangle = std::holds_alternative<TriangleNet>(net);
      const dvec2 at = triangle ? make.in_triangle() : dvec2(make.uniform(0, 1));
      const dvec3 p = net_point(net, at.x, at.y);
      // Ulps of the control points, which lie up to a few times as far out as the points.
      worst.add(distance_from(matrix, p), 32 * 0x1p-52 * (1 + glm::length(p)),
                [&] { return std::string(c.parameters); });
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

// A random line aimed at a point of the patch must meet the patch there, where the equation has a root; and
// every hit is a root.
TEST_CASE("rays meet quadric patches where the equation says", "[surfaces]") {
  NetMaker make(62);
  WorstCase worst;
  int lost = 0, invented = 0, hits = 0, rays = 0;
  for (const QuadricCase& c : quadric_cases) {
    const Surface surface = build_family(object(c.parameters));
    const lmat4 matrix = matrix_of(c.quadric);
    for (const Solver solver : {Solver::newton, Solver::clipping}) {
      const Tracer tracer({{surface, solver}});
      for (int k = 0; k < 1000; ++k) {
        const Net& net = surface.patches[static_cast<std::size_t>(k) % surface.patches.size()];
        dvec2 at = make.in_triangle();
        // The other half of a square, too.
        if (k % 2 == 1 && std::holds_alternative<TensorNet>(net)) at = 1.0 - at;
        at = 0.01 + 0.97 * at;
        const dvec3 target = net_point(net, at.x, at.y);
        Ray ray;
        ray.origin = target + dvec3(make.uniform(-3, 3), make.uniform(-3, 3), make.uniform(-3, 3));
        ray.direction = target - ray.origin;
        const Meeting expected = meet(matrix, ray);
        const auto describe = [&] { return fmt::format("{} ray {}", c.parameters, k); };
        const std::vector<Hit> found = tracer.all(ray);
        ++rays;
        bool at_target = false;
        for (const Hit& hit : found) {
          ++hits;
          double off = INFINITY;
          for (int i = 0; i < expected.count; ++i) off = std::min(off, std::abs(hit.t - expected.t[i]));
          const double cosine = std::abs(glm::dot(hit.normal, ray.direction)) / glm::length(ray.direction);
          // Some ulps on the surface, stretched along the ray; a double root to its square root.
          const double stretch = 64 * 0x1p-52 * (1 + glm::length(hit.point)) / glm::length(ray.direction);
          worst.add(off, std::min(stretch / cosine, std::sqrt(stretch)) + 16 * 0x1p-52, describe);
          at_target = at_target || std::abs(hit.t - 1.0) < 1e-6;
        }
        lost += !at_target;
        invented += static_cast<int>(found.size()) > expected.count;
      }
    }
  }
  INFO(rays << " rays, " << hits << " hits; " << worst.text());
  CHECK(worst.failures() == 0);
  CHECK(lost == 0);
  CHECK(invented == 0);
}

TEST_CASE("on a closed ellipsoid every line meets as many patches as roots", "[surfaces]") {
  NetMaker make(63);
  const Surface surface = build_family(object(quadric_cases[0].parameters));
  const Tracer tracer({{surface, Solver::newton}});
  const lmat4 matrix = matrix_of(quadric_cases[0].quadric);
  int wrong = 0, twice = 0;
  for (int k = 0; k < 2000; ++k) {
    Ray ray;
    ray.origin = {make.uniform(-4, 4), make.uniform(-4, 4), -3};
    ray.direction = dvec3(make.uniform(-2, 2), make.uniform(-1, 1), make.uniform(-0.5, 0.5)) - ray.origin;
    const Meeting expected = meet(matrix, ray);
    wrong += static_cast<int>(tracer.all(ray).size()) != expected.count;
    twice += expected.count == 2;
  }
  CHECK(wrong == 0);
  CHECK(twice > 1000);
}

TEST_CASE("rulings bound patches by straight lines where they say", "[surfaces]") {
  const Surface surface = build_family(
      object(R"("quadric": "one_sheet", "semi_axes": [1, 2, 3], "rulings": [[-30, 40], [-20, 35]])"));
  const auto& net = std::get<TensorNet>(surface.patches.at(0));
  CHECK((net.m == 1 && net.n == 1));
  const dvec3 corner = net_point(net, 1.0, 0.0);  // longitude 40 - 20, height tan(40 + 20)
  const double radians = std::acos(-1.0) / 180.0;
  CHECK(corner.z == Approx(3 * std::tan(60 * radians)));
  CHECK(corner.y / corner.x == Approx(2 * std::tan(20 * radians)));
  const Surface other =
      build_family(object(R"("quadric": "hyperbolic_paraboloid", "rulings": [[-1, 2], [-2, 1]])"));
  CHECK(glm::distance(net_point(other.patches.at(0), 1.0, 1.0), dvec3(1.5, 0.5, 2)) < 1e-15);
}

TEST_CASE("patches between plane sections have the least degree and their sides", "[surfaces]") {
  const auto net_of = [](const std::string& rest) {
    const Surface surface = build_family(object(("\"quadric\": " + rest).c_str()));
    return std::get<TensorNet>(surface.patches.at(0));
  };
  const std::string band =
      R"("one_sheet", "corners": [[1.25,0,-0.75],[0,1.25,-0.75],[0,1.25,0.75],[1.25,0,0.75]],
         "sections": [{"plane": [0,0,1,-0.75]}, null, {"plane": [0,0,1,0.75]}, null])";
  const TensorNet low = net_of(band);
  CHECK((low.m == 2 && low.n == 2));
  for (int k = 0; k <= 2; ++k) {
    CHECK(low.at(k, 0).z == Approx(-0.75 * low.at(k, 0).w));
    CHECK(low.at(k, 2).z == Approx(0.75 * low.at(k, 2).w));
    CHECK(std::abs(low.at(0, k).y) < 1e-15);
    CHECK(std::abs(low.at(2, k).x) < 1e-15);
  }
  CHECK(glm::distance(net_point(low, 1, 0), dvec3(0, 1.25, -0.75)) < 1e-15);
  CHECK(glm::distance(net_point(low, 1, 1), dvec3(0, 1.25, 0.75)) < 1e-15);
  // The shorter arc of the parallel.
  CHECK(net_point(low, 0.5, 0).x > 0.8);
  const TensorNet high = net_of(band + R"(, "construction": "degree_2_4", "quartic": "v")");
  CHECK((high.m == 2 && high.n == 4));
  const TensorNet turned = net_of(band + R"(, "construction": "degree_2_4", "quartic": "u")");
  CHECK((turned.m == 4 && turned.n == 2));
  const TensorNet saddle_square =
      net_of(R"("hyperbolic_paraboloid", "corners": [[-1,-1,0],[1,-1,0],[1,1,0],[-1,1,0]])");
  CHECK((saddle_square.m == 2 && saddle_square.n == 2));
  CHECK(glm::distance(net_point(saddle_square, 0.5, 0.5), dvec3(0)) < 1e-15);
  CHECK(glm::distance(net_point(saddle_square, 0.5, 0), dvec3(0, -1, -1)) < 1e-15);
}

TEST_CASE("what no quadric patch can be is refused", "[surfaces]") {
  const auto refused = [](const char* parameters, const std::string& part) {
    const std::string message = family_error(object(parameters));
    INFO(parameters << "\n" << message);
    CHECK(message.find(part) != std::string::npos);
  };
  refused(R"("quadric": "ellipsoid")", "give the patch as");
  refused(R"("surface": {"type": "sphere_cap"}, "rulings": [[0,1],[0,1]])",
          "either \"surface\" or \"rulings\"");
  refused(R"("surface": {"type": "sphere"})", "must be of a type that makes patches of the sphere");
  refused(R"("surface": {"type": "sphere_cap", "radius": 2})", "radius");
  refused(R"("surface": {"type": "sphere_cap", "z_max": 2})", "z_max");
  refused(R"("surface": {"type": "sphere_tiling"}, "quadric": "two_sheets")", "one side of z = 0");
  refused(R"("surface": {"type": "sphere_tiling"}, "quadric": "elliptic_paraboloid")",
          "must not contain (0, 0, 1)");
  // The pole in the middle of a patch, where the weight touches zero but for rounding.
  refused(R"("surface": {"type": "sphere_tiling", "topology": "cube_2_4"}, "quadric": "elliptic_paraboloid")",
          "must not contain (0, 0, 1)");
  refused(R"("surface": {"type": "sphere_tiling"}, "quadric": "one_sheet")", "carries straight lines");
  refused(R"("rulings": [[0,1],[0,1]])", "carries no straight lines");
  refused(R"("quadric": "one_sheet", "rulings": [[0,100],[0,1]])", "90 degrees or more");
  refused(R"("quadric": "one_sheet", "rulings": [[1,0],[0,1]])", "the lower first");
  refused(R"("quadric": "one_sheet", "rulings": [[0,1]])", "two intervals");
  refused(R"("corners": [[1,0,0],[0,1,0],[0,0,1],[1,1,1]])", "of type \"circular_quad\"");
  const std::string square =
      R"("quadric": "hyperbolic_paraboloid", "corners": [[-1,-1,0],[1,-1,0],[1,1,0],[-1,1,0]])";
  const auto sections = [&](const std::string& first, const std::string& part) {
    refused((square + R"(, "sections": [)" + first + ", null, null, null]").c_str(), part);
  };
  sections(R"({"plane": [0,0,1,1]})", "the plane of sections[0] must contain both corners");
  sections(R"({"plane": [0,1,0,-1], "through": [0,-1,-1]})", "either \"through\" or \"plane\"");
  sections(R"({"through": [0,-1,1]})", "does not lie on the quadric");
  sections(R"({"through": [0,0,0]})", "must not lie on a straight line");
  sections("1", "sections[0] must be null");
  refused(R"("quadric": "hyperbolic_paraboloid", "corners": [[-1,-1,0],[1,-1,0],[1,1,0],[-1,1,0.5]])",
          "corners[3] does not lie on the quadric");
  refused(R"("quadric": "hyperbolic_paraboloid", "corners": [[-1,-1,0],[1,-1,0],[1.5,1,1.25],[-1,1,0]],
      "sections": [null, {"through": [1.25,0.5,1.3125]}, null, null], "construction": "biquadratic")",
          "corners 0 and 2 lie in a plane");
  refused(R"("quadric": "hyperbolic_paraboloid", "corners": [[-1,-1,0],[1,1,0],[1,-1,0],[-1,1,0]])",
          "folds: sides must not cross");
  refused(R"("rulings": [[0,1],[0,1]], "quartic": "u")", "\"quartic\" has no meaning");
  refused(R"("surface": {"type": "sphere_cap"}, "matrix": [[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,0]])",
          "an elliptic cone");
  refused(R"("surface": {"type": "sphere_cap"}, "matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]])",
          "an imaginary ellipsoid");
  refused(R"("surface": {"type": "sphere_cap"}, "matrix": [[1,0,0,0],[0,1,0,0],[0,0,0,0],[0,0,0,-1]])",
          "an elliptic cylinder");
  refused(R"("surface": {"type": "sphere_cap"}, "matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[1,0,0,-1]])",
          "must be symmetric");
  refused(R"("surface": {"type": "sphere_cap"}, "matrix": [[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,0]])",
          "a plane or nothing");
  refused(R"("surface": {"type": "sphere_cap"}, "semi_axes": [1,1,1], "matrix": [[1,0,0,0]])",
          "\"matrix\" says all");
  refused(R"("quadric": "one_sheet", "preimage": [
      {"degree": [1, 1], "net": [[[-1,-1,1,2],[-1,1,1,2]],[[1,-1,1,2],[1,1,1,2]]]}])",
          "(u, v) = (0.5, 0.5)");
}

}  // namespace rondure
