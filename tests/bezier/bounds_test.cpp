// Boxes contain what they bound, are near it, and are refused where there are none. Nets under maps.
#include "renderer/bezier/bounds.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <limits>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/transform.h"
#include "renderer/projective/planar_patch.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// How far a point lies outside a box.
double outside(const Box& box, const dvec3& p) {
  double most = 0.0;
  for (int c = 0; c < 3; ++c) most = std::max({most, box.low[c] - p[c], p[c] - box.high[c]});
  return most;
}

void sample(NetMaker& make, const Net& net, const Box& box, int count, WorstCase& worst) {
  for (int k = 0; k < count; ++k) {
    dvec2 at(make.uniform(0.0, 1.0), make.uniform(0.0, 1.0));
    if (std::holds_alternative<TriangleNet>(net)) at = make.in_triangle();
    // Corners are control points, hence often the box's own extremes.
    if (k < 3) at = {k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
    const dvec3 p = net_point(net, at.x, at.y);
    // The point itself is rounded: some eps of the weighted sum over the weight.
    const double error = outside(box, p);
    worst.add(error, 1e-14 * (1.0 + glm::length(p)),
              [&] { return fmt::format("({}, {}): {}", at.x, at.y, error); });
  }
}

}  // namespace

TEST_CASE("boxes of nets with weights of one sign contain the patch", "[bezier]") {
  NetMaker make(51);
  WorstCase worst;
  for (int k = 0; k < 40; ++k) {
    Net net = k % 2 == 0 ? Net(make.tensor(1 + k % 12, 1 + k % 7)) : Net(make.triangle(1 + k % 12));
    if (k % 3 == 0) {
      for (dvec4& p : points_of(net)) p = -p;
    }
    const auto box = bounds_of(net);
    REQUIRE(box.has_value());
    sample(make, net, *box, 50, worst);
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("boxes of nets with weights of both signs contain the patch, closely", "[bezier]") {
  NetMaker make(52);
  WorstCase worst;
  // The whole cap from radius 2 sqrt((1 + z) / (1 - z)): with the paper's middle weight of 1 some weights are
  // negative.
  for (const double z : {0.3, 0.6, 12.0 / 13.0}) {
    const double radius = 2.0 * std::sqrt((1.0 + z) / (1.0 - z));
    const Net net = sphere_patch(disk(radius, 1), 1);
    const auto& points = points_of(net);
    const auto negative = [](const dvec4& p) { return p.w < 0.0; };
    CHECK(std::any_of(points.begin(), points.end(), negative));
    const auto box = bounds_of(net);
    REQUIRE(box.has_value());
    sample(make, net, *box, 2000, worst);
    for (int c = 0; c < 3; ++c) {
      CHECK(box->low[c] > -4.0);
      CHECK(box->high[c] < 4.0);
    }
  }
  TriangleNet triangle(2);
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; j <= 2 - i; ++j) triangle.at(i, j) = make.point(1.0, 2.0);
  }
  triangle.at(1, 1).w = -0.5;
  const auto box = bounds_of(Net(triangle));
  REQUIRE(box.has_value());
  sample(make, Net(triangle), *box, 2000, worst);
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("a patch through infinity, or without finite coordinates, has no box", "[bezier]") {
  NetMaker make(53);
  TensorNet net = make.tensor(2, 2);
  net.at(0, 0).w = -1.0;
  CHECK_FALSE(bounds_of(Net(net)).has_value());
  net = make.tensor(2, 2);
  net.at(2, 1).w = 0.0;
  net.at(2, 0).w = 0.0;  // the weight vanishes on a corner
  CHECK_FALSE(bounds_of(Net(net)).has_value());
  net = make.tensor(2, 2);
  net.at(1, 1).x = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(bounds_of(Net(net)).has_value());
  net.at(1, 1).x = std::numeric_limits<double>::infinity();
  CHECK_FALSE(bounds_of(Net(net)).has_value());
  net.at(1, 1) = {1.0, 1.0, 1.0, 1e-310};  // the quotient overflows
  CHECK_FALSE(bounds_of(Net(net)).has_value());
  CHECK_FALSE(bounds_of(Net(TensorNet())).has_value());
  TriangleNet triangle = make.triangle(3);
  triangle.at(3, 0).w = -1.0;
  CHECK_FALSE(bounds_of(Net(triangle)).has_value());
}

TEST_CASE("maps of nets are maps of points, and keep outward normals outward", "[bezier]") {
  NetMaker make(54);
  WorstCase worst;
  int mirrored = 0;
  for (int k = 0; k < 30; ++k) {
    const Net net = k % 2 == 0 ? Net(make.tensor(2, 3)) : Net(make.triangle(3));
    dmat4 map(1.0);
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) map[column][row] += make.uniform(-1.0, 1.0);
      map[column][3] += make.uniform(-0.1, 0.1);  // projective, but nothing goes to infinity
    }
    if (k % 4 >= 2) map[0] = -map[0];
    const Net image = transformed(net, map);
    const bool mirrors = glm::determinant(map) < 0.0;
    if (mirrors) ++mirrored;
    const dvec2 at = make.in_triangle();
    dvec2 there = at;
    if (mirrors) there = k % 2 == 0 ? dvec2(1.0 - at.x, at.y) : dvec2(at.y, at.x);
    const dvec4 h = map * dvec4(net_point(net, at.x, at.y), 1.0);
    const double error = glm::length(net_point(image, there.x, there.y) - dvec3(h) / h.w);
    worst.add(error, 1e-14, [&] { return fmt::format("map {}: {}", k, error); });
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(mirrored > 3);

  // A sphere through a projective map that keeps it closed: outside stays outside, by either sign of the
  // determinant.
  const Net south = sphere_patch(disk(2, 1), 1);
  for (const double sign : {1.0, -1.0}) {
    dmat4 map(1.0);
    map[0][0] = 2.0 * sign;
    map[2][3] = 0.3;
    const Net image = transformed(south, map);
    // The south pole's image is the lowest point of the image.
    CHECK(unit_normal(image, 0.5, 0.5).z < -0.9);
  }
  const Net turned = reversed(south);
  CHECK(unit_normal(turned, 0.5, 0.5).z == Approx(1.0));
}

}  // namespace rondure
