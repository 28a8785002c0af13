// The rational map's derivatives and curvature.
#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/transform.h"
#include "renderer/projective/planar_patch.h"
#include "tests/bezier/oracle.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using oracle::Big;

struct BigVector {
  Big c[3];
};

BigVector surface_point(const Net& net, const Big& u, const Big& v) {
  const oracle::BigPoint x = oracle::derivative(net, 0, 0, u, v);
  return {{x.c[0] / x.c[3], x.c[1] / x.c[3], x.c[2] / x.c[3]}};
}

// Central differences in 50 digits with a step of 1e-12: the truncation is near 1e-24, the rounding near
// 1e-26.
BigVector difference(const Net& net, int a, int b, const Big& u, const Big& v) {
  const Big h("1e-12");
  const auto shifted = [&](int i, int j) { return surface_point(net, u + i * h, v + j * h); };
  BigVector d{};
  for (int c = 0; c < 3; ++c) {
    if (a + b == 1) d.c[c] = (shifted(a, b).c[c] - shifted(-a, -b).c[c]) / (2 * h);
    if (a == 2 || b == 2) {
      const int i = a / 2, j = b / 2;
      d.c[c] = (shifted(i, j).c[c] - 2 * shifted(0, 0).c[c] + shifted(-i, -j).c[c]) / (h * h);
    }
    if (a == 1 && b == 1) {
      d.c[c] = (shifted(1, 1).c[c] - shifted(1, -1).c[c] - shifted(-1, 1).c[c] + shifted(-1, -1).c[c]) /
               (4 * h * h);
    }
  }
  return d;
}

double distance(const dvec3& computed, const BigVector& exact) {
  double largest = 0.0;
  for (int c = 0; c < 3; ++c) {
    largest = std::max(largest, static_cast<double>(abs(Big(computed[c]) - exact.c[c])));
  }
  return largest;
}

}  // namespace

TEST_CASE("derivatives of the rational map agree with differences in 50 digits", "[bezier]") {
  NetMaker make(21);
  WorstCase worst;
  for (int k = 0; k < 12; ++k) {
    const Net net = k % 2 == 0 ? Net(make.tensor(1 + k % 5, 2 + k % 4)) : Net(make.triangle(1 + k % 6));
    const dvec2 at = make.in_triangle();
    const SurfaceJet s = surface_jet(net, at.x, at.y);
    const Big u = at.x, v = at.y;
    const struct {
      dvec3 computed;
      int a, b;
    } all[] = {{s.du, 1, 0}, {s.dv, 0, 1}, {s.duu, 2, 0}, {s.duv, 1, 1}, {s.dvv, 0, 2}};
    worst.add(distance(s.point, surface_point(net, u, v)), 1e-14,
              [&] { return fmt::format("point of net {}", k); });
    for (const auto& [computed, a, b] : all) {
      const double error = distance(computed, difference(net, a, b, u, v));
      // Weights from 0.5 and degrees to 6: derivatives up to a few hundred, from some tens of rounded terms.
      worst.add(error, 2e-12,
                [&, a = a, b = b] { return fmt::format("net {}, order ({}, {}): {}", k, a, b, error); });
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("curvature of ellipsoids", "[bezier]") {
  NetMaker make(22);
  const Net sphere = sphere_patch(disk(2, 1), 1);
  WorstCase regular, corners;
  const dvec3 shapes[] = {{1.0, 1.0, 1.0}, {2.0, 2.0, 2.0}, {1.0, 2.0, 0.5}, {-1.0, 1.5, 1.0}};
  for (const dvec3& axes : shapes) {
    dmat4 map(1.0);
    for (int c = 0; c < 3; ++c) map[c][c] = axes[c];
    const Net net = transformed(sphere, map);
    const auto check = [&](double u, double v, double tolerance, WorstCase& worst) {
      const dvec3 p = net_point(net, u, v);
      const dvec3 a2 = axes * axes;
      const double s = p.x * p.x / (a2.x * a2.x) + p.y * p.y / (a2.y * a2.y) + p.z * p.z / (a2.z * a2.z);
      const double volume2 = a2.x * a2.y * a2.z;
      const double gaussian = 1.0 / (volume2 * s * s);
      // Outward normals: the mean curvature is negative.
      const double mean = (glm::dot(p, p) - a2.x - a2.y - a2.z) / (2.0 * volume2 * std::pow(s, 1.5));
      const Curvature c = curvature(net, u, v);
      const double error = std::max(std::abs(c.gaussian / gaussian - 1.0), std::abs(c.mean / mean - 1.0));
      worst.add(error, tolerance,
                [&] { return fmt::format("axes x {}, ({}, {}): {}", axes.x, u, v, error); });
    };
    // Ten percent from the singular corners first derivatives still have an angle of some degrees.
    for (int k = 0; k < 50; ++k) check(make.uniform(0.1, 0.9), make.uniform(0.1, 0.9), 1e-12, regular);
    // At a corner the value is taken 1e-4 further inside, where an ellipsoid's curvature differs by as much
    // times the ratio of its axes, here up to 4 in the fourth power; rounding over an area of 1e-8 adds 1e-7.
    for (const double d : {0.0, 1e-12, 1e-6}) check(d, 1.0 - d, 1e-4, corners);
    // So near that the area's square is not in a double's range.
    for (const double d : {1e-300, 1e-200, 1e-80, 1e-40}) check(d, d, 1e-4, corners);
  }
  INFO(regular.text());
  INFO(corners.text());
  CHECK(regular.failures() == 0);
  CHECK(corners.failures() == 0);
}

}  // namespace rondure
