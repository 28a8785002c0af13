// Tubes along curves: how far their skin is from the true offset, where it is exact, what happens at cusps.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/rational.h"
#include "renderer/bezier/tube.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// The true offset is what lies at the radius from some foot of a perpendicular. How much `point` is off from
// the nearest of these, and which way out is there.
struct Off {
  double distance = INFINITY;
  dvec3 outward{0.0};
};

Off off_from(const RationalCurve& curve, const dvec3& point, double radius) {
  const auto slope = [&](double t) {
    const CurveJet jet = curve_jet(curve, t);
    return glm::dot(point - jet.point, jet.first);
  };
  Off off;
  // A little beyond the ends, where the feet of the end sections may be found by rounding.
  constexpr int steps = 240;
  const auto parameter = [](int k) { return -0.002 + 1.004 * k / steps; };
  double before = slope(parameter(0));
  for (int k = 1; k <= steps; ++k) {
    const double after = slope(parameter(k));
    if ((before > 0.0) != (after > 0.0)) {
      double low = parameter(k - 1), high = parameter(k);
      for (int halving = 0; halving < 48; ++halving) {
        const double middle = 0.5 * (low + high);
        ((slope(middle) > 0.0) == (before > 0.0) ? low : high) = middle;
      }
      const dvec3 way = point - curve_point(curve, low);
      const double distance = std::abs(glm::length(way) - radius);
      if (distance < off.distance) off = {distance, glm::normalize(way)};
    }
    before = after;
  }
  return off;
}

}  // namespace

TEST_CASE("the skin of a tube is within its accuracy of the true offset", "[bezier]") {
  NetMaker make(321);
  WorstCase worst, outward, joints;
  std::size_t patches = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const int degree = 2 + trial % 7;
    const double radius = trial % 3 == 0 ? 0.05 : trial % 3 == 1 ? 0.01 : 0.002;
    RationalCurve curve;
    for (int k = 0; k <= degree; ++k) {
      const double w = make.uniform(0.3, 3.0);
      const dvec3 p(2.0 * k / degree, make.uniform(-1.0, 1.0), make.uniform(-1.0, 1.0));
      curve.emplace_back(w * p, w);
    }
    const CurveTube tube = curve_tube(curve, radius);
    CHECK(tube.cusps.empty());
    patches += tube.nets.size();
    for (std::size_t k = 0; k < tube.nets.size(); ++k) {
      const Net net = tube.nets[k];
      for (int sample = 0; sample < 3; ++sample) {
        const double u = make.uniform(0.0, 1.0), v = make.uniform(0.0, 1.0);
        const dvec3 p = net_point(net, u, v);
        const Off off = off_from(curve, p, radius);
        const auto where = [&] { return fmt::format("trial {}, patch {} at ({}, {})", trial, k, u, v); };
        worst.add(off.distance / radius, tube_accuracy, where);
        // The slope of an error of 1e-3 over a span's quarter, which is longer than a fiftieth of the radius.
        outward.add(1.0 - glm::dot(off.outward, unit_normal(net, u, v)), 5e-3, where);
      }
      if (k + 3 >= tube.nets.size()) continue;
      for (int i = 0; i <= 2; ++i) {
        joints.add(tube.nets[k].at(i, 3) == tube.nets[k + 3].at(i, 0) ? 0.0 : 1.0, 0.5,
                   [&] { return fmt::format("trial {}, patch {}", trial, k); });
      }
    }
    const auto ends = [&](double t, const dvec3& tangent) {
      CHECK(glm::distance(tangent, glm::normalize(curve_jet(curve, t).first)) < 1e-14);
    };
    ends(0.0, tube.start);
    ends(1.0, tube.end);
  }
  INFO(worst.text() << "\n" << outward.text() << "\n" << joints.text() << "\n" << patches << " patches");
  CHECK(worst.failures() == 0);
  CHECK(worst.error() > 0.02 * tube_accuracy);  // no more patches than are needed
  CHECK(outward.failures() == 0);
  CHECK(joints.failures() == 0);
}

TEST_CASE("tubes along circular arcs and lines are exact", "[bezier]") {
  NetMaker make(322);
  WorstCase worst;
  const double radius = 0.05;
  for (const double angle : {0.2, 1.5, 1.6, 3.0, 3.3, 5.0, 6.2}) {
    // Weights 1, cos(half angle), 1; then one more degree and another parametrisation.
    const double half = 0.5 * angle;
    const dvec3 centre(make.point()), x = glm::normalize(dvec3(make.point())),
                                      y = glm::normalize(glm::cross(x, dvec3(make.point())));
    RationalCurve arc = {dvec4(centre + std::cos(half) * x - std::sin(half) * y, 1.0),
                         dvec4(std::cos(half) * centre + x, std::cos(half)),
                         dvec4(centre + std::cos(half) * x + std::sin(half) * y, 1.0)};
    const RationalCurve raised = {arc[0], (arc[0] + 2.0 * arc[1]) / 3.0, (2.0 * arc[1] + arc[2]) / 3.0,
                                  arc[2]};
    RationalCurve faster = arc;
    faster[1] *= 1.3, faster[2] *= 1.69;
    for (const RationalCurve& curve : {arc, raised, faster}) {
      const CurveTube tube = curve_tube(curve, radius);
      CHECK(tube.nets.size() == 3 * static_cast<std::size_t>(std::ceil(angle / 1.5707963)));
      for (const TensorNet& net : tube.nets) {
        REQUIRE((net.m == 2 && net.n == 2));
        const dvec3 p = net_point(net, make.uniform(0.0, 1.0), make.uniform(0.0, 1.0)) - centre;
        const double up = glm::dot(p, glm::cross(x, y)), out = glm::length(p - up * glm::cross(x, y)) - 1.0;
        // The circle's centre is found from points that are good to about 4 epsilon / (smallest weight), 0.02
        // for the longest arc, and amplified by (1 / angle)^2 for the shortest.
        worst.add(std::abs(std::hypot(up, out) - radius), 4000.0 * epsilon,
                  [&] { return fmt::format("{} radians", angle); });
      }
      CHECK(glm::distance(tube.start, std::sin(half) * x + std::cos(half) * y) < 1e-12);
      CHECK(glm::distance(tube.end, -std::sin(half) * x + std::cos(half) * y) < 1e-12);
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  const RationalCurve line = {dvec4(0, 0, 0, 1), dvec4(0.2, 0.4, 0.6, 2), dvec4(1, 2, 3, 1)};
  const CurveTube straight = curve_tube(line, radius);
  CHECK(straight.nets.size() == 3);
  CHECK(straight.nets[0].n == 1);
  CHECK(straight.start == straight.end);
}

TEST_CASE("a tube that rounding would show in is refused", "[bezier]") {
  const RationalCurve bent = {dvec4(0, 0, 0, 1), dvec4(0.5, 0, 0, 0.5), dvec4(1, 1, 0, 1)};
  CHECK(curve_tube(bent, 1e-8).nets.size() > 100);
  CHECK_THROWS_WITH(curve_tube(bent, 1e-10), "the tube is too thin for the size of the curve");
  // Rounding of points where a weight of 1e-9 meets control points of weight 1.
  const RationalCurve wild = {dvec4(0, 0, 0, 1), dvec4(-1, 0, 0, -1 + 1e-13), dvec4(1e-9, 1, 0, 1)};
  CHECK_THROWS(curve_tube(wild, 1e-5));
}

TEST_CASE("at cusps and turning points a tube leaves a place for a ball", "[bezier]") {
  // c' = (3/4) (1, 1) + ... vanishes at t = 1/2, and nowhere else.
  const RationalCurve cusp = {dvec4(0, 0, 0, 1), dvec4(1, 1, 0, 1), dvec4(0, 1, 0, 1), dvec4(1, 0, 0, 1)};
  const double radius = 0.02;
  const CurveTube tube = curve_tube(cusp, radius);
  REQUIRE_FALSE(tube.cusps.empty());
  for (const dvec3& at : tube.cusps) CHECK(glm::distance(at, dvec3(0.5, 0.75, 0)) <= tube_accuracy * radius);
  CHECK(tube.start != dvec3(0.0));
  CHECK(tube.end != dvec3(0.0));
  // There and part of the way back.
  const CurveTube back = curve_tube({dvec4(0, 0, 0, 1), dvec4(1, 0, 0, 1), dvec4(0.2, 0, 0, 1)}, radius);
  REQUIRE_FALSE(back.cusps.empty());
  CHECK(std::abs(back.cusps[0].x - 1.0 / 1.8) < 1e-3);
  CHECK(curve_tube({dvec4(1, 2, 3, 1), dvec4(2, 4, 6, 2)}, radius).nets.empty());
}

}  // namespace rondure
