// The `iss` family: what it reads, what it refuses, and how it says so.
#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/rational_curve.h"
#include "renderer/intersect/tracer.h"
#include "renderer/scene/wires.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

std::string iss(const std::string& rest) { return R"({"type": "iss", )" + rest + "}"; }

const TriangleNet& first_net(const Surface& s) { return std::get<TriangleNet>(s.patches.front()); }

}  // namespace

TEST_CASE("iss takes coefficients in three forms", "[iss]") {
  const auto radius_of_middle = [](const std::string& patch) {
    const Surface s = build_family(
        iss(R"("vertices": [[2,0,0],[0,1,0],[0,0,1]], "patches": [{"triangle": [0,1,2], )" + patch + "}]"));
    const dvec4& p = first_net(s).at(1, 1);
    return glm::length(dvec3(p) / p.w);
  };
  CHECK(radius_of_middle(R"("c": {"111": 0.25, "rest": 1})") == Approx(4.0).epsilon(1e-15));
  CHECK(radius_of_middle(R"("radii": {"111": 4, "rest": 1})") == Approx(4.0).epsilon(1e-15));
  // u_111 = (2, 1, 1) / 3.
  CHECK(radius_of_middle(R"("weights": 0.5)") == Approx(2.0 * std::sqrt(6.0) / 3.0).epsilon(1e-15));
  CHECK(radius_of_middle(R"("radii": 3)") == Approx(3.0).epsilon(1e-15));
}

TEST_CASE("moduli replace lengths, and move directions", "[iss]") {
  const Surface a = build_family(iss(R"("vertices": [[2.5,0,0],[0,1,0],[0,0,1]])"));
  const Surface b = build_family(iss(R"("vertices": [[7,0,0],[0,3,0],[0,0,1]], "moduli": [2.5, 1, 1])"));
  const Surface c = build_family(iss(R"("moduli": [2.5, 1, 1])"));
  CHECK(first_net(a).points == first_net(b).points);
  CHECK(first_net(a).points == first_net(c).points);
  CHECK_FALSE(first_net(a).points == first_net(build_family(R"({"type": "iss"})")).points);
}

TEST_CASE("normals point away from the origin whatever the order of corners", "[iss]") {
  for (const char* order : {"[0,1,2]", "[1,0,2]"}) {
    for (const char* form : {"triangles", "degenerate", "quadrilaterals"}) {
      const Surface s =
          build_family(iss(fmt::format(R"("patches": [{{"triangle": {}}}], "form": "{}")", order, form)));
      for (const Net& net : s.patches) {
        CHECK(glm::dot(unit_normal(net, 0.3, 0.3), net_point(net, 0.3, 0.3)) > 0.0);
      }
    }
  }
}

TEST_CASE("the surface is the same however it is modified", "[iss]") {
  const std::string plain =
      R"("degree": 2, "patches": [{"triangle": [0,1,2], "c": {"110": 0.7, "002": 1.2, "rest": 1}}])";
  const Net whole = build_family(iss(plain)).patches.front();
  const Surface parts = build_family(iss(plain + R"(, "modify": [{"elevate": 4}, {"split": {"at": [1, 1, 2]}},
    {"quarter": {"patch": 1}}, {"split": {"patch": 0, "direction": [1, 4, 5]}}])"));
  CHECK(parts.patches.size() == 3 + 1 + 4);
  for (const Net& net : parts.patches) {
    CHECK(std::get<TriangleNet>(net).n == 4);
    const dvec3 p = net_point(net, 0.2, 0.5);
    // On the plane x + y + z = 1 the direction's parameters are its coordinates.
    const dvec3 tau = p / (p.x + p.y + p.z);
    CHECK(glm::distance(net_point(whole, tau.x, tau.y), p) < 1e-14);
  }
}

TEST_CASE("an iss has the sides of its domains as guides", "[iss]") {
  const Surface flat = build_family(iss(R"("patches": [{"triangle": [0,1,2], "radii": 2}])"));
  REQUIRE(flat.guides.at("domain").size() == 3);
  REQUIRE(flat.guides.at("spherical_triangle").size() == 3);
  for (const Guide& side : flat.guides.at("spherical_triangle")) {
    // Halfway between two axes.
    const dvec3 middle = curve_point(side.curve, 0.5);
    CHECK(glm::length(middle) == Approx(1.0).epsilon(1e-15));
    CHECK(middle.x + middle.y + middle.z == Approx(std::sqrt(2.0)).epsilon(1e-15));
  }
  CHECK(build_family(iss(R"("patches": [{"sphere": [0,1,2]}])")).guides.at("domain").empty());
}

TEST_CASE("an iss is drawn over great-circle arcs", "[iss]") {
  const std::string circle =
      R"("arcs": [{"from": [1,0,0.2], "to": [-1,1,0]}, {"from": [-1,1,0], "to": [0,-1,-0.3]}])";
  const std::string model =
      R"("octants": {"degree": 3, "interior": [0.25, 1.75, 1.75, 0.25, 1.75, 0.25, 0.25, 1.75]})";
  // Rays along an arc's directions pass the surface in the middle of the wire: in and out at distances of the
  // wire's radius, over the cosine of the angle at which the ray meets it.
  const Surface surface = build_family(iss(model + ", " + circle));
  CHECK(surface.closed);
  Wires wires(0.02);
  for (const Guide& guide : surface.guides.at("arcs")) wires.add(guide.curve, guide.end_balls);
  Surface drawn;
  drawn.patches = wires.nets();
  const Tracer wire({{drawn, Solver::newton}}), whole({{surface, Solver::newton}});
  WorstCase worst;
  const dvec3 from = glm::normalize(dvec3(1, 0, 0.2)), to = glm::normalize(dvec3(-1, 1, 0));
  const dvec3 normal = glm::normalize(glm::cross(from, to));
  for (int k = 1; k < 40; ++k) {
    const double t = k / 40.0;
    const dvec3 d = glm::normalize((1.0 - t) * from + t * to);
    const std::vector<Hit> hits = wire.all({dvec3(0.0), d});
    const std::vector<Hit> middle = whole.all({dvec3(0.0), d});
    REQUIRE(middle.size() == 1);
    REQUIRE(hits.size() >= 2);
    // The curve's slope against the direction, from the surface's normal: in the arc's plane.
    const dvec3 across = glm::normalize(middle[0].normal - glm::dot(middle[0].normal, normal) * normal);
    const double expected = 0.02 / glm::dot(across, d);
    // The curve bends by up to a third of the tube's radius over its width; that enters squared.
    for (const Hit* hit : {&hits.front(), &hits.back()})
      worst.add(std::fabs(std::fabs(hit->t - middle[0].t) / expected - 1.0), 0.05,
                [&] { return fmt::format("{} of the arc", t); });
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("iss says what is wrong", "[iss]") {
  const std::pair<const char*, const char*> cases[] = {
      {R"("vertices": [[1,0,0],[0,1,0],[1,1,0]])", "lie on one great circle"},
      {R"("vertices": [[1,0,0],[0,0,0],[1,1,0]])", "a vertex is three numbers, not all zero"},
      {R"("vertices": [[1,0,0],[0,1,0]])", "which vertices make a triangle?"},
      {R"("moduli": [1, 2])", "\"moduli\" has 2 numbers for 3 vertices"},
      {R"("moduli": [1, 2, -1])", "a modulus must be in [0.0001, 10000]"},
      {R"("moduli": [1, 2, 1e5])", "a modulus must be in [0.0001, 10000]"},
      {R"("patches": [])", "there is no patch"},
      {R"("patches": [{}])", "a patch needs \"triangle\", \"u\", \"sphere\" or \"join\""},
      {R"("patches": [{"triangle": [0,1,3]}])", "must be an integer in [0, 2]"},
      {R"("patches": [{"triangle": [0,1]}])", "names three vertices, not 2"},
      {R"("patches": [{"triangle": [0,1,1]}])", "lie on one great circle"},
      {R"("patches": [{"triangle": [0,1,2], "sphere": [0,1,2]}])", "give one of \"triangle\" and \"sphere\""},
      {R"("patches": [{"triangle": [0,1,2], "c": 1, "radii": 1}])", "give one of \"c\" and \"radii\""},
      {R"("patches": [{"triangle": [0,1,2], "c": 0}])", "coefficient for all must be a positive number"},
      {R"("patches": [{"triangle": [0,1,2], "c": {"111": -1, "rest": 1}}])",
       "coefficient \"111\" must be a positive"},
      {R"("patches": [{"triangle": [0,1,2], "c": {"111": 1}}])", "coefficient \"300\" is missing"},
      {R"("patches": [{"triangle": [0,1,2], "c": {"112": 1, "rest": 1}}])",
       "\"112\" is no index of degree 3"},
      {R"("patches": [{"triangle": [0,1,2], "c": {"1,1,1": 1, "111": 1, "rest": 1}}])", "given twice"},
      {R"("patches": [{"sphere": [0,1,2], "c": 1}])", "unknown key \"c\""},
      {R"("degree": 1, "patches": [{"u": {"100": [1,0,0], "010": [0,1,0]}}])", "vector \"001\" is missing"},
      {R"("degree": 1, "patches": [{"u": {"100": [1,0,0], "010": [0,1,0], "001": [0,0,0]}}])",
       "not all zero"},
      {R"("degree": 2, "patches": [{"u": {"200": [1,0,0], "020": [0,1,0], "002": [0,0,1], "110": [1,1,0],
         "101": [1,0.1,1], "011": [0,1,1]}}])",
       "101 does not lie on the great circle"},
      {R"("degree": 3, "patches": [{"u": {"300": [1,0,0], "030": [0,1,0], "003": [0,0,1], "210": [2,1,0], "120": [1,2,0],
         "201": [2,0,1], "102": [1,0,2], "021": [0,2,1], "012": [0,1,2], "111": [0.1,1,0.02]}}])",
       "the sub-triangle <120, 021, 111> is inverted"},
      {R"("degree": 3, "patches": [{"u": {"300": [1,0,0], "030": [0,1,0], "003": [0,0,1], "210": [36,16,0], "120": [1,3,0],
         "201": [40,0,24], "102": [7,0,6], "021": [0,24,24], "012": [0,4,6], "111": [48,128,16]}}])",
       "the surface is not single-valued: the projection domain folds over"},
      {R"("patches": [{"join": {"patch": 0, "across": 0, "vertex": 1}}])",
       "there is no patch before this one"},
      {R"("vertices": [[1,0,0],[0,1,0],[0,0,1],[1,1,1]], "patches": [{"triangle": [0,1,2]},
         {"join": {"patch": 0, "across": 0, "vertex": 3}}])",
       "is not negative"},
      {R"("vertices": [[1,0,0],[0,1,0],[0,0,1],[-1,1,1]], "patches": [{"triangle": [0,1,2]},
         {"join": {"patch": 0, "across": 0, "vertex": 3}, "c": {"102": 1, "rest": 1}}])",
       "coefficient \"102\" follows from the others here"},
      {R"("vertices": [[1,0,0],[0,1,0],[0,0,1],[-1,1,1]], "patches": [{"sphere": [0,1,2]},
         {"join": {"patch": 0, "across": 0, "vertex": 3}}])",
       "patch 0 has no planar projection domain"},
      {R"("octants": {"degree": 2})", "\"degree\" must be an integer in [3, 24]"},
      {R"("octants": {"interior": [1, 2]})", "\"interior\" has 2 entries for 8 patches"},
      {R"("octants": {"interior": {"300": 1}})", "coefficient \"300\" follows from the others here"},
      {R"("octants": {}, "degree": 4)", "give one of \"octants\", \"fan\""},
      {R"("fan": {"sides": 2})", "\"sides\" must be an integer in [3, 100]"},
      {R"("fan": {"a": [1,0,0], "b": [2,0,0]})", "must not contain the origin"},
      {R"("fan": {"weights": {"420": 9, "411": 0.1, "rest": 1}})", "not positive"},
      {R"("modify": [{"elevate": 2}])", "a patch has degree 3 already"},
      {R"("modify": [{}])", "a step is one of"},
      {R"("modify": [{"split": {}}])", "give one of \"at\" (barycentric) and \"direction\""},
      {R"("modify": [{"split": {"direction": [-1,-1,-1]}}])", "into the inside of the spherical triangle"},
      {R"("modify": [{"quarter": {"patch": 1}}])", "\"patch\" must be an integer in [0, 0]"},
      {R"("patches": [{"sphere": [0,1,2]}], "modify": [{"quarter": {}}])", "Remark 7.1"},
      {R"("modify": [{"quarter": {}}, {"quarter": {}}, {"quarter": {}}, {"quarter": {}}, {"quarter": {}}, {"quarter": {}},
         {"quarter": {}}, {"quarter": {}}, {"quarter": {}}])",
       "more than 100000 patches"},
      {R"("form": "quads")", "\"form\" must be one of"},
      {R"("arcs": [{"from": [1,1,1], "to": [2,2,2]}])", "neither parallel nor opposite"},
      {R"("arcs": [{"from": [1,1,1], "to": [-1,-1,-1]}])", "neither parallel nor opposite"},
      {R"("arcs": [{"from": [-1,1,1], "to": [-1,0,0]}])", "the arc passes by every patch"},
      {R"("patches": [{"sphere": [0,1,2]}], "arcs": [{"from": [1,1,2], "to": [1,0,0]}])", "Remark 7.1"},
  };
  for (const auto& [object, message] : cases) {
    INFO(object);
    CHECK_THAT(family_error(iss(object)), Catch::Contains(message));
    CHECK_THAT(family_error(iss(object)), Catch::Contains("object.json:"));
  }
}

}  // namespace rondure
