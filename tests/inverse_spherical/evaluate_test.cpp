// The paper's algorithms against the definition in 50 digits, and the surface as a function of direction.
#include "renderer/inverse_spherical/evaluate.h"

#include <fmt/format.h>

#include "renderer/bezier/epsilon.h"
#include "tests/bezier/oracle.h"
#include "tests/catch.h"
#include "tests/inverse_spherical/random_iss.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

dvec3 exact_point(const TriangleNet& net, dvec2 at, double* distance_of = nullptr,
                  const dvec3* computed = nullptr) {
  const oracle::BigPoint p = oracle::derivative(net, 0, 0, oracle::Big(at.x), oracle::Big(at.y));
  oracle::Big d = 0;
  dvec3 out;
  for (int c = 0; c < 3; ++c) {
    const oracle::Big x = p.c[c] / p.c[3];
    out[c] = static_cast<double>(x);
    if (computed) d += (x - oracle::Big((*computed)[c])) * (x - oracle::Big((*computed)[c]));
  }
  if (distance_of) *distance_of = static_cast<double>(sqrt(d));
  return out;
}

}  // namespace

TEST_CASE("Algorithms 1, 2 and 3 and the explicit form agree to rounding", "[iss]") {
  NetMaker make(11);
  WorstCase one, two, three, sums, direction;
  for (int n = 1; n <= 9; ++n) {
    for (int trial = 0; trial < 20; ++trial) {
      const PlanarIss planar = random_planar_iss(make, n);
      const bool flat = trial % 2 == 0;
      const Iss s = flat ? general_form(planar) : random_general_iss(make, n);
      const TriangleNet net = flat ? net_of(planar) : net_of(s);
      for (int k = 0; k < 5; ++k) {
        const dvec2 at = k == 0 ? dvec2(0.0, 1.0) : make.in_triangle();
        const auto say = [&] { return fmt::format("degree {} at ({}, {})", n, at.x, at.y); };
        // All sums are of terms of one sign but for the coordinates of u, which are bounded by the largest
        // |u|, up to 2.75, over weights of at least 0.5 * 0.2: a few epsilon a step, n steps, relative to |u|
        // / w.
        double size = 0.0, weight = 1e300;
        for (const dvec4& p : net.points)
          size = std::max(size, glm::length(dvec3(p))), weight = std::min(weight, p.w);
        const double tolerance = 6.0 * (n + 2) * epsilon * size / weight;
        const auto check = [&](WorstCase& worst, const dvec3& computed) {
          double off = 0.0;
          exact_point(net, at, &off, &computed);
          worst.add(off, tolerance, say);
        };
        check(one, point_by_casteljau(net, at.x, at.y));
        const SphericalPoint p = point_by_spherical_casteljau(s, at.x, at.y);
        check(two, p.point());
        direction.add(std::abs(glm::length(p.direction) - 1.0), 4.0 * epsilon, say);
        check(sums, point_by_sums(s, at.x, at.y));
        if (flat) check(three, point_by_weights(planar, at.x, at.y));
      }
    }
  }
  INFO("Algorithm 1: " << one.text());
  INFO("Algorithm 2: " << two.text());
  INFO("Algorithm 3: " << three.text());
  INFO("equation 7: " << sums.text());
  CHECK(one.failures() + two.failures() + three.failures() + sums.failures() == 0);
  CHECK(direction.failures() == 0);
  CHECK(three.count() == 9 * 10 * 5);
}

TEST_CASE("a planar-domain surface is a function of direction", "[iss]") {
  NetMaker make(12);
  WorstCase radius, nothing;
  for (int n = 1; n <= 9; ++n) {
    for (int trial = 0; trial < 30; ++trial) {
      const PlanarIss s = random_planar_iss(make, n);
      const dvec2 at = trial == 0 ? dvec2(1.0, 0.0) : make.in_triangle();
      const dvec3 p = exact_point(net_of(s), at);
      const std::optional<double> r = radius_towards(s, make.uniform(0.01, 100.0) * p);
      REQUIRE(r.has_value());
      const auto say = [&] { return fmt::format("degree {} at ({}, {})", n, at.x, at.y); };
      // Of the direction's rounding, times moduli over the determinant (up to 2.5 / 0.2), degree 9 and
      // weights that differ by up to 4 * 6.
      radius.add(std::abs(*r / glm::length(p) - 1.0), 12.5 * n * 24.0 * 4.0 * epsilon, say);
      // Against the point on the other side of the sphere, and beyond a side, there is nothing.
      nothing.add(radius_towards(s, -p).has_value() ? 1.0 : 0.0, 0.5, say);
      const dvec3 beyond = s.corners[0] + s.corners[1] - 0.01 * s.corners[2];
      nothing.add(radius_towards(s, beyond).has_value() ? 1.0 : 0.0, 0.5, say);
    }
  }
  INFO(radius.text());
  CHECK(radius.failures() == 0);
  CHECK(nothing.failures() == 0);
}

TEST_CASE("the radius depends on the direction alone, across renamed corners", "[iss]") {
  NetMaker make(13);
  WorstCase worst;
  for (int trial = 0; trial < 60; ++trial) {
    const PlanarIss s = random_planar_iss(make, 1 + trial % 7);
    const dvec2 at = make.in_triangle();
    const dvec3 p = exact_point(net_of(s), at);
    for (int first = 1; first < 3; ++first) {
      const std::optional<double> r = radius_towards(rotated(s, first), p);
      REQUIRE(r.has_value());
      worst.add(std::abs(*r / glm::length(p) - 1.0), 12.5 * 7 * 24.0 * 4.0 * epsilon,
                [&] { return fmt::format("trial {}", trial); });
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

}  // namespace rondure
