// The `curve` family: a ray from a point of the curve at right angles to it meets the tube at its radius.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/bounds.h"
#include "renderer/bezier/tube.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

class Probe {
 public:
  explicit Probe(const std::string& rest)
      : tracer_({TracedSurface{build_family(R"({"type": "curve", )" + rest + "}"), Solver::newton}}) {}

  // How much the skin along this direction is off from the radius, relative to it.
  double off(const dvec3& point, const dvec3& direction, double radius) const {
    const Hit hit = tracer_.closest({point, glm::normalize(direction)});
    return hit ? std::abs(hit.t / radius - 1.0) : INFINITY;
  }

 private:
  Tracer tracer_;
};

}  // namespace

TEST_CASE("curves on the sphere pass through their points", "[surfaces]") {
  // Radially a curve on the sphere lies at right angles; across its ends are the balls.
  const auto through = [](const std::string& rest, const std::vector<dvec3>& points, double tolerance) {
    const Probe probe(rest + R"(, "tube": 0.03)");
    WorstCase worst;
    for (const dvec3& p : points) {
      for (const double side : {-1.0, 1.0})
        worst.add(probe.off(glm::normalize(p), side * p, 0.03), tolerance,
                  [&] { return fmt::format("({}, {}, {}) {}", p.x, p.y, p.z, side); });
    }
    INFO(rest << "\n" << worst.text());
    CHECK(worst.failures() == 0);
  };
  const std::vector<dvec3> five = {{0, 0, -1}, {1, 2, -2}, {6, 2, 3}, {1, 4, 8}, {-2, 1, 2}};
  through(R"("interpolate": [[0,0,-1], [1,2,-2], [6,2,3], [1,4,8], [-2,1,2]])", five, 1.01 * tube_accuracy);
  through(
      R"("interpolate": [[0,0,-1], [1,2,-2], [6,2,3], [1,4,8], [-2,1,2]], "parameters": [0, 0.2, 0.5, 0.8, 1])",
      five, 1.01 * tube_accuracy);
  // Circles are exact; 1e-12 is their rounding over the radius of the tube, with room.
  through(R"("spline": [[0,0,-1], [1,2,-2], [6,2,3], [1,4,8], [-2,1,2]], "through": [1, 1, -4])", five,
          1e-12);
  through(R"("spline": [[0,0,-1], [1,2,-2], [6,2,3]])", {{0, 0, -1}, {1, 2, -5}, {1, 2, -2}, {6, 2, 3}},
          1e-12);
  const std::vector<dvec3> three = {{1, 2, -2}, {6, 2, 3}, {1, 4, 8}};
  through(R"("arc": [[1,2,-2], [6,2,3], [1,4,8]])", three, 1e-12);
  through(R"("circle": [[1,2,-2], [6,2,3], [1,4,8]])", three, 1e-12);
  // The circle of latitude z = 3/5, all around.
  std::vector<dvec3> latitude;
  for (int k = 0; k < 12; ++k) latitude.emplace_back(0.8 * std::cos(k), 0.8 * std::sin(k), 0.6);
  through(R"("circle": [[0.8,0,0.6], [0,0.8,0.6], [-0.64,-0.48,0.6]])", latitude, 1e-12);
}

TEST_CASE("an arc ends where it should", "[surfaces]") {
  const Probe probe(R"("arc": [[1,0,0], [1,1,0], [0,1,0]], "tube": 0.05)");
  CHECK(probe.off({1, 0, 0}, {0, -1, 0}, 0.05) < 1e-12);  // a ball
  CHECK(probe.off({0, 1, 0}, {-1, 0, 0}, 0.05) < 1e-12);
  CHECK(probe.off({-1, 0, 0}, {0, 0, 1}, 0.05) > 1.0);
  // No ball inside a smooth spline, but one at a corner: 6 patches each.
  const auto patches = [](const std::string& rest) {
    return build_family(R"({"type": "curve", )" + rest + "}");
  };
  CHECK(patches(R"("circle": [[1,0,0], [0,1,0], [-1,0,0]])").patches.size() == 18);
  CHECK(patches(R"("arc": [[1,0,0], [1,1,0], [0,1,0]])").patches.size() == 3 + 12);
  CHECK(patches(R"("spline": [[1,0,0], [0,1,0], [-1,0,0]])").patches.size() == 6 + 12);
  CHECK(patches(R"("net": [[0,0,0,1], [1,0,0,1], [1,1,0,1]], "degree": 1)").patches.size() == 6 + 18);
  CHECK(patches(R"("net": [[0,0,0,1], [1,0,0,1], [2,0,0,1]], "degree": 1)").patches.size() == 6 + 12);
  CHECK(patches(R"("net": [[0,0,0,1], [1,0,0,1], [1,1,0,1], [0,0,0,1]], "degree": 1)").patches.size() ==
        9 + 18);
}

TEST_CASE("curves in space and from projective space", "[surfaces]") {
  // A B-spline of degree 2 in the plane z = 0, uniform knots: its middle knot is the middle of two points.
  const Probe spline(R"("net": [[0,0,0,1], [1,0,0,1], [1,1,0,1], [2,1,0,1]], "degree": 2, "tube": 0.01)");
  CHECK(spline.off({1, 0.5, 0}, {0, 0, 1}, 0.01) < tube_accuracy);
  CHECK(spline.off({0, 0, 0}, {0, 0, 1}, 0.01) < tube_accuracy);
  // Knots that start the curve at the second: at t = 1, (c0 + c1) / 2.
  const Probe open(
      R"("net": [[0,0,0,1], [1,0,0,1], [1,1,0,1], [2,1,0,1]], "knots": [-1,0,1,2,3,4,5], "tube": 0.01)");
  CHECK(open.off({0.5, 0, 0}, {0, 0, 1}, 0.01) < tube_accuracy);
  CHECK(open.off({0, 0, 0}, {0, 0, 1}, 0.01) > 1.0);
  // Rational: weights 1, 2, 1 put the middle of the parabola at (P0 + 2 P1 2 + P2) / 6.
  const Probe conic(R"("net": [[0,0,0,1], [2,0,0,2], [1,1,0,1]], "tube": 0.01)");
  CHECK(conic.off({5.0 / 6.0, 1.0 / 6.0, 0}, {0, 0, 1}, 0.01) < tube_accuracy);
  // (1, t, 0, 0) under delta runs along the meridian y = 0.
  const Probe meridian(R"("preimage": [[1,0,0,0], [1,1,0,0]], "tube": 0.01)");
  CHECK(meridian.off({0.8, 0, -0.6}, {0, 1, 0}, 0.01) < 1e-12);
}

TEST_CASE("curves on other quadrics", "[surfaces]") {
  // Along the quadric's normal a curve on it lies at right angles.
  const auto check = [](const std::string& rest, const dvec3& point, const dvec3& normal) {
    INFO(rest);
    const Probe probe(rest + R"(, "tube": 0.01)");
    for (const double side : {-1.0, 1.0}) CHECK(probe.off(point, side * normal, 0.01) < 1.01 * tube_accuracy);
  };
  check(R"("circle": [[1,0,0], [0,1,0], [0,0,1]], "semi_axes": [1, 2, 3])", {0, 2, 0}, {0, 1, 0});
  check(R"("interpolate": [[0.6,0,-0.8], [0,0,-1], [0,0.6,-0.8]], "quadric": "two_sheets")", {0, 0, 1},
        {0, 0, 1});
  // (x, y, z, w) = (3, 0, 4, 5) / 5 goes to (x, y, w + z, w - z), z/c = x^2 + y^2.
  check(R"("arc": [[3,0,4], [0,0,-1], [-3,0,4]], "quadric": "elliptic_paraboloid")", {3, 0, 9}, {6, 0, -1});
  // Half the waist; a straight line; a parabola in the plane y = 0 of z = x^2 - y^2.
  check(R"("preimage": [[1,0,0,1], [0,1,1,0]], "quadric": "one_sheet")", {0, 1, 0}, {0, 1, 0});
  check(R"("preimage": [[1,0,0,1], [1,0,1,1]], "quadric": "one_sheet")", {1, 0.5, -0.5}, {1, 0.5, 0.5});
  check(R"("preimage": [[1,-1,-1,1], [1,1,1,1]], "quadric": "hyperbolic_paraboloid")", {0, 0, 0}, {0, 0, 1});
  // A B-spline on it, of two pieces that share their polygon's point.
  const Surface spline = build_family(
      R"({"type": "curve", "preimage": [[1,0,0,1], [1,1,0,1], [1,1,1,1]], "degree": 1, "quadric": "one_sheet"})");
  CHECK(spline.guides.at("net").size() == 4);
}

TEST_CASE("a control polygon has finite legs", "[surfaces]") {
  // About a whole circle an equilateral triangle, twice as far away; half a circle has a point at infinity.
  for (const char* points :
       {"[1,0,0], [0,1,0], [-1,0,0]", "[1,0,0], [0,0.001,1], [0,0,1]", "[3,4,5], [5,4,3], [-4,5,3]"}) {
    const Surface circle = build_family(fmt::format(R"({{"type": "curve", "circle": [{}]}})", points));
    double farthest = 0.0;
    const std::vector<Guide>& legs = circle.guides.at("net");
    for (const Guide& leg : legs) {
      for (const dvec4& p : leg.curve) farthest = std::max(farthest, glm::length(dvec3(p) / p.w));
    }
    INFO(points);
    CHECK(legs.size() == 6);
    CHECK(farthest < 2.0 + 1e-12);
  }
  const Surface half = build_family(R"({"type": "curve", "arc": [[1,0,0], [0.6,0.8,0], [-1,0,0]]})");
  CHECK(half.guides.at("net").empty());
}

TEST_CASE("a curve that comes back to where it was is drawn on the way", "[surfaces]") {
  // x = 3 t (1 - t)^2 - 3 t^2 (1 - t): its start, middle and end are one point.
  const Surface surface =
      build_family(R"({"type": "curve", "net": [[0,0,0,1],[1,0,0,1],[-1,0,0,1],[0,0,0,1]]})");
  Box box;
  for (const Net& net : surface.patches) box.add(*bounds_of(net));
  const double reach = std::sqrt(1.0 / 12.0);  // at t = 1/2 -+ 1/sqrt(12)
  CHECK(box.high.x > reach);
  CHECK(box.low.x < -reach);
}

TEST_CASE("what is wrong with a curve is said", "[surfaces]") {
  const auto says = [](const std::string& rest) { return complaint(R"({"type": "curve", )" + rest + "}"); };
  CHECK(says(R"("tube": 1)") ==
        "the object: give the curve as one of \"net\", \"preimage\", \"interpolate\", \"spline\", \"arc\", "
        "\"circle\"");
  CHECK(says(R"("arc": [[1,0,0],[0,1,0],[0,0,1]], "net": [])") == "give either \"net\" or \"arc\", not both");
  CHECK(says(R"("arc": [[1,0,0],[0,1,0],[0,0,1]], "knots": [])") == "\"knots\" has no meaning for \"arc\"");
  CHECK(says(R"("net": [[0,0,0,1],[1,0,0,1]], "quadric": "one_sheet")") ==
        "\"quadric\" has no meaning for \"net\"");
  CHECK(says(R"("arc": [[1,0,0],[0,1,0],[0,0,1]], "quadric": "one_sheet")") ==
        "this quadric carries straight lines and is no image of the sphere: give a \"preimage\"");
  CHECK(says(R"("arc": [[1,0,0],[0,1,0],[0,0,1]], "quadric": "elliptic_paraboloid")") ==
        "the curve reaches infinity, or has no point, where its weight is zero");
  CHECK(says(R"("net": [[0,0,0,1]])") == "\"net\" must be an array of at least 2 control points");
  CHECK(says(R"("net": [[0,0,0,1],[1,0,0]])") ==
        "a control point must be an array of four numbers, [wx, wy, wz, w]");
  CHECK(says(R"("net": [[0,0,0,1],[1,0,0,-1]])") ==
        "the curve reaches infinity, or has no point, where its weight is zero");
  CHECK(says(R"("preimage": [[0,0,0,1],[0,0,0,-1]])") ==
        "the four coordinates of the preimage vanish together somewhere on the curve");
  CHECK(says(R"("net": [[1,0,0,1],[2,0,0,2]])") == "the object: the curve is a single point, beside the radius of its tube at least");
  CHECK(says(R"("net": [[1,0,0,1],[2,0,0,1]], "degree": 2)") == "degree 2 needs 3 control points at least");
  CHECK(says(R"("net": [[1,0,0,1],[2,0,0,1]], "degree": 1, "knots": [0,0,1])") ==
        "2 control points of degree 1 need 4 knots, not 3");
  CHECK(says(R"("net": [[1,0,0,1],[2,0,0,1]], "knots": [0,0])") ==
        "the object: as many knots say, these control points would make a curve of degree -1; degrees are 1 "
        "to 24");
  CHECK(says(R"("interpolate": [[1,0,0],[0,1,0],[0,0,1],[1,1,1]])") ==
        "a curve of degree 2n on the sphere passes through 2n + 1 points: give an odd number of them, 25 at "
        "most, not 4");
  CHECK(says(R"("interpolate": [[1,0,0],[0,1,0],[0,0,1]], "parameters": [0, 0.5])") ==
        "\"parameters\" must be 3 numbers from 0 to 1, one for each point");
  CHECK(says(R"("interpolate": [[1,0,0],[0,1,0],[0,0,1]], "parameters": [0, 1, 1])") ==
        "\"parameters\" must increase");
  // Four points on one circle as (1 - t, t) runs along it, and one off it.
  CHECK(
      says(
          R"("interpolate": [[1,0,0],[15,8,0],[3,4,0],[0,0,1],[0,1,0]], "parameters": [0, 0.25, 0.5, 0.75, 1])")
          .find("does not pass through point 3: such points are inaccessible") != std::string::npos);
  for (const char* points :
       {"[[1,0,0],[1,0,0],[0,1,0]]", "[[1,0,0],[0,1,0],[0,1,0]]", "[[1,0,0],[1,0,0],[1,0,0]]"}) {
    CHECK(says(fmt::format(R"("interpolate": {})", points)).find("such points are inaccessible") !=
          std::string::npos);
  }
  // So nearly infinite in its middle that parameters that are doubles cannot follow it.
  CHECK(says(R"("net": [[0,0,0,1],[1,1,0,-0.999999],[2,0,0,1]])") ==
        "the curve winds too much, or its weights differ too much, for so thin a tube");
  CHECK(says(R"("net": [[0,0,0,1],[1,0,0,1],[1,1,0,1]], "tube": 1e-12)") ==
        "the tube is too thin for the size of the curve");
  CHECK(says(R"("spline": [[1,0,0],[0,1,0],[0,2,0]])") == "this is the same point as another beside it");
  CHECK(says(R"("spline": [[1,0,0],[-1,0,0]])") ==
        "the first two points are opposite: give a point \"through\" which the first arc passes");
  CHECK(says(R"("circle": [[1,0,0],[0,1,0]])").find("\"circle\" must be") == 0);
  CHECK(says(R"("arc": [[1,0,0],[0,1,0],[0,0,1],[1,1,1]])") ==
        "\"arc\" must be three directions, [x, y, z] each");
}

TEST_CASE("an interpolation tells its conditioning", "[surfaces]") {
  const auto condition = [](double gap) {
    const Surface surface = build_family(fmt::format(
        R"({{"type": "curve", "interpolate": [[0,0,-1], [1,2,-2], [1,2,{}], [1,4,8], [-2,1,2]],
             "parameters": [0, 0.2, {}, 0.8, 1]}})",
        -2 + 10 * gap, 0.2 + gap));
    REQUIRE(surface.notes.size() == 1);
    CHECK(surface.notes[0].name == "condition");
    return surface.notes[0].value;
  };
  // As a point and its parameter come to be those of another, their equations do, and the least singular
  // value is in proportion to what is left between them.
  const double wide = condition(0.3), near = condition(1e-4), nearer = condition(1e-5);
  CHECK(wide > 1e-3);
  CHECK(near < 0.1 * wide);
  CHECK(nearer / near == Approx(0.1).epsilon(0.05));
  CHECK(build_family(R"({"type": "curve", "arc": [[1,2,-2], [6,2,3], [1,4,8]]})").notes.empty());
}

}  // namespace rondure
