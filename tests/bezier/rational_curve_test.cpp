// Rational curves, and the lines of nets, against the evaluation of nets.
#include "renderer/bezier/rational_curve.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/rational.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {

TEST_CASE("a curve is evaluated as a net that does not depend on v", "[bezier]") {
  NetMaker make(311);
  WorstCase worst;
  for (int degree = 1; degree <= 12; ++degree) {
    for (int trial = 0; trial < 10; ++trial) {
      TensorNet net(degree, 1);
      RationalCurve curve;
      for (int i = 0; i <= degree; ++i) {
        const double w = make.uniform(0.5, 2.0);
        curve.emplace_back(w * dvec3(make.point()), w);
        net.at(i, 0) = net.at(i, 1) = curve.back();
      }
      const double t = make.uniform(0.0, 1.0);
      const CurveJet jet = curve_jet(curve, t);
      const SurfaceJet expected = surface_jet(net, t, 0.5);
      // Differences of coefficients of size 2 to 4, times n and n (n - 1), over weights of 1/2 at least.
      const double n = degree, size = 32.0 * epsilon * n;
      const auto add = [&](const dvec3& a, const dvec3& b, double scale, const char* what) {
        worst.add(glm::length(a - b), size * scale,
                  [&] { return fmt::format("{} of degree {}", what, degree); });
      };
      add(jet.point, expected.point, 1.0, "point");
      add(curve_point(curve, t), expected.point, 1.0, "point alone");
      add(jet.first, expected.du, n, "first");
      add(jet.second, expected.duu, 8.0 * n * n, "second");
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("lines of a net are curves", "[bezier]") {
  NetMaker make(312);
  WorstCase worst;
  for (int trial = 0; trial < 40; ++trial) {
    const int m = 1 + trial % 5, n = 1 + trial % 4;
    const Net tensor = make.tensor(m, n), triangle = make.triangle(1 + trial % 6);
    const double a = make.uniform(0.0, 1.0), b = make.uniform(0.0, 1.0), c = make.uniform(0.0, 1.0);
    const auto check = [&](const Net& net, dvec2 from, dvec2 to) {
      const RationalCurve curve = curve_on(net, from, to);
      for (const double t : {0.0, 0.3, 1.0}) {
        const dvec2 at = from + t * (to - from);
        worst.add(glm::length(curve_point(curve, t) - net_point(net, at.x, at.y)), 256.0 * epsilon,
                  [&] { return fmt::format("trial {} at {}", trial, t); });
      }
    };
    check(tensor, {a, b}, {a, c});
    check(tensor, {a, b}, {c, b});
    check(triangle, {a * b, (1.0 - a) * b}, {c, (1.0 - c) * a});
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  // Boundaries are the net's own control points.
  const TensorNet net = make.tensor(3, 2);
  const RationalCurve side = curve_on(net, {0.0, 1.0}, {1.0, 1.0});
  for (int i = 0; i <= 3; ++i) CHECK(side[static_cast<std::size_t>(i)] == net.at(i, 2));
  const TriangleNet triangle = make.triangle(4);
  const RationalCurve edge = curve_on(triangle, {1.0, 0.0}, {0.0, 1.0});
  for (int i = 0; i <= 4; ++i) CHECK(edge[static_cast<std::size_t>(i)] == triangle.at(4 - i, i));
}

TEST_CASE("a curve is finite where its weight has no zero", "[bezier]") {
  const auto weights = [](std::initializer_list<double> w) {
    RationalCurve curve;
    for (const double x : w) curve.emplace_back(1.0, 2.0, 3.0, x);
    return is_finite(curve);
  };
  CHECK(weights({1.0, 1.0}));
  CHECK(weights({-1.0, -2.0}));
  CHECK_FALSE(weights({1.0, -1.0}));
  CHECK_FALSE(weights({0.0, 1.0}));
  CHECK(weights({1.0, -0.99, 1.0}));  // (1 + w) / 2 in the middle
  CHECK(weights({1.0, -1.0 + 1e-9, 1.0}));
  CHECK_FALSE(weights({1.0, -1.0, 1.0}));
  CHECK_FALSE(weights({1.0, -1.01, 1.0}));
  CHECK_FALSE(weights({1.0, INFINITY, 1.0}));
}

}  // namespace rondure
