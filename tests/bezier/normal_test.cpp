// Normals where the parametrisation degenerates.
#include "renderer/bezier/normal.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/tensor.h"
#include "renderer/bezier/transform.h"
#include "renderer/bezier/triangle.h"
#include "renderer/projective/planar_patch.h"
#include "tests/bezier/oracle.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// The angle between unit vectors, accurate when it is small.
double angle(const dvec3& a, const dvec3& b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(a - b)));
}

const Net& hemisphere() {
  static const Net net = sphere_patch(disk(2, 1), 1);
  return net;
}

// A quarter circle turned by a quarter: v = 1 collapses to the pole.
Net octant() {
  const double h = std::sqrt(0.5);
  const double c[3][3] = {{1.0, 0.0, 1.0}, {h, h, h}, {0.0, 1.0, 1.0}};
  TensorNet net(2, 2);
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; j <= 2; ++j) {
      net.at(i, j) = {c[i][0] * c[j][0], c[i][1] * c[j][0], c[i][2] * c[j][1], c[i][2] * c[j][2]};
    }
  }
  return net;
}

// On the unit sphere the outward normal is the point. A point is good to about 6 eps; unit_normal promises
// 1e-11 where it takes the cross product (its own error bound) and better where it takes the polynomial.
constexpr double sphere_tolerance = 1.5e-11;

void compare_with_sphere(const Net& net, double u, double v, WorstCase& worst) {
  const double error = angle(unit_normal(net, u, v), net_point(net, u, v));
  worst.add(error, sphere_tolerance, [&] { return fmt::format("({:.17g}, {:.17g}): {}", u, v, error); });
}

}  // namespace

TEST_CASE("normals are right at and near the singular corners of the hemisphere", "[bezier][normal]") {
  WorstCase worst;
  for (int corner = 0; corner < 4; ++corner) {
    for (int k = 0; k <= 72; ++k) {
      const double distance = k == 72 ? 0.0 : std::pow(10.0, -0.25 * k);
      for (int direction = 0; direction <= 8; ++direction) {
        const double du = distance * (1.0 - direction / 8.0);
        const double dv = distance * (direction / 8.0);
        const double u = corner % 2 == 0 ? du : 1.0 - du;
        const double v = corner / 2 == 0 ? dv : 1.0 - dv;
        compare_with_sphere(hemisphere(), u, v, worst);
      }
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("normals are right at and near the collapsed edge of the octant", "[bezier][normal]") {
  const Net net = octant();
  WorstCase worst;
  for (int k = 0; k <= 72; ++k) {
    const double distance = k == 72 ? 0.0 : std::pow(10.0, -0.25 * k);
    for (int step = 0; step <= 16; ++step) compare_with_sphere(net, step / 16.0, 1.0 - distance, worst);
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
  CHECK(angle(unit_normal(net, 0.3, 1.0), dvec3(0.0, 0.0, 1.0)) < 1e-15);
}

TEST_CASE("normals hold under very unequal weights", "[bezier][normal]") {
  // Most of these surfaces lies within 10^-3 to 10^-6 of their domain's edge. The control points are rounded,
  // which moves a normal by an epsilon times the ratio of the weights about it: up to some 10^6 here.
  const std::pair<const char*, double> families[] = {
      {R"({"type": "sphere_cap", "z_max": 0.999})", 1e-11},
      {R"({"type": "sphere_cap", "z_max": 0.999999})", 1e-11},
      {R"({"type": "sphere_cap", "middle_weight": 5000})", 1e-11},
      {R"({"type": "sphere_cap", "z_max": 0.3, "middle_weight": 1e6})", 1e-8},
      {R"({"type": "stereographic_patch", "x": [-1000, -1], "y": [-1e-3, 1e-3]})", 1e-9},
      {R"({"type": "composed_patch", "of": {"type": "sphere_tiling", "topology": "cube"}, "domain": {"degree": [1, 1],
          "net": [[[0.1, 0.1, 1], [1000, 9000, 10000]], [[9000, 1000, 10000], [0.9, 0.9, 1]]]}})",
       1e-11},
  };
  NetMaker make(23);
  WorstCase worst;
  for (const auto& [text, tolerance] : families) {
    const Surface surface = build_family(text);
    const Net& net = surface.patches.at(0);
    const auto near_an_end = [&] {
      const double t = std::pow(10.0, make.uniform(-18.0, 0.0));
      return make.uniform(0.0, 1.0) < 0.5 ? t : 1.0 - t;
    };
    for (int k = 0; k < 400; ++k) {
      const bool inner = k % 2 == 0;
      const double u = inner ? make.uniform(0.0, 1.0) : near_an_end();
      const double v = inner ? make.uniform(0.0, 1.0) : near_an_end();
      const double error = angle(unit_normal(net, u, v), net_point(net, u, v));
      worst.add(error, tolerance,
                [&] { return fmt::format("{} at ({:.17g}, {:.17g}): {}", text, u, v, error); });
    }
    for (int corner = 0; corner < 4; ++corner) {
      const double u = corner % 2, v = corner / 2;
      const double error = angle(unit_normal(net, u, v), net_point(net, u, v));
      worst.add(error, tolerance, [&] { return fmt::format("{} at corner {}: {}", text, corner, error); });
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("limit normals survive an affine map and a change of scale", "[bezier][normal]") {
  WorstCase worst;
  for (const double scale : {1e-6, 1.0, 1e6}) {
    dmat4 map(scale);
    map[0][0] = 3.0 * scale;
    map[1][0] = 0.5 * scale;  // a shear: the map is not symmetric
    map[2][2] = -0.25 * scale;
    map[3][3] = 1.0;
    const Net net = transformed(hemisphere(), map);
    for (const double distance : {1e-2, 1e-5, 1e-8, 1e-12, 0.0}) {
      for (const double v : {0.0, 0.5 * distance, distance}) {
        // The map mirrors, so u of the image runs backwards.
        const dvec3 n = net_point(hemisphere(), 1.0 - distance, v);
        const dvec3 expected = glm::normalize(glm::transpose(glm::inverse(dmat3(map))) * n);
        const double error = angle(unit_normal(net, distance, v), expected);
        worst.add(error, 10.0 * sphere_tolerance,
                  [&] { return fmt::format("scale {}, distance {}, v {}: {}", scale, distance, v, error); });
      }
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("a net times any factor is the same surface, with the same normals", "[bezier][normal]") {
  for (const double factor : {-1.0, 0x1p-330, 0x1p330}) {
    Net net = hemisphere();
    for (dvec4& p : points_of(net)) p *= factor;
    for (const double t : {0.0, 1e-9, 1e-3, 0.4}) {
      // A product of tangents that would underflow or overflow is rounded in other units: by some eps.
      CHECK(angle(unit_normal(net, t, 0.0), unit_normal(hemisphere(), t, 0.0)) < 1e-14);
    }
  }
}

TEST_CASE("corners with parallel tangents have the limit of the inner normals", "[bezier][normal]") {
  NetMaker make(11);
  WorstCase worst;
  for (int k = 0; k < 40; ++k) {
    const bool triangle = k % 2 == 1;
    Net net = triangle ? Net(make.triangle(2 + k % 5)) : Net(make.tensor(2 + k % 3, 2 + k % 4));
    // The control points beside the corner (0, 0) in line with it, on opposite sides, as on Cobb's
    // hemisphere; of few bits, so that they are so exactly.
    for (dvec4& p : points_of(net)) p = glm::round(p * 1048576.0) / 1048576.0;
    dvec4* p = points_of(net).data();
    const int beside_u =
        triangle ? triangle_index(std::get<TriangleNet>(net).n, 1, 0) : std::get<TensorNet>(net).n + 1;
    p[beside_u] = p[0] - 0.75 * (p[1] - p[0]);
    // Along the diagonal, at a distance where terms of second order are below 1e-10. With 50 digits nothing
    // is lost.
    const oracle::Big tiny("1e-12");
    const dvec3 limit = oracle::normal(net, tiny, tiny);
    const double error = angle(unit_normal(net, 0.0, 0.0), limit);
    // The first non-vanishing coefficients may be small against the net: then their direction is less
    // certain.
    worst.add(error, 1e-10, [&] { return fmt::format("net {}: {}", k, error); });
    const double near = angle(unit_normal(net, 1e-7, 2e-7), oracle::normal(net, 1e-7, 2e-7));
    worst.add(near, 1e-10, [&] { return fmt::format("net {}, near: {}", k, near); });
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("the octant has its normals at any radius", "[bezier][normal]") {
  WorstCase worst;
  for (const double radius : {1e-300, 1e-100, 1e-12, 1e-7, 1.0, 1e14, 1e100, 1e300}) {
    for (const double side : {1.0, -1.0}) {
      dmat4 mirror(1.0);
      mirror[2][2] = side;
      Net net = transformed(octant(), mirror);
      for (dvec4& p : points_of(net)) p = dvec4(radius * dvec3(p), p.w);
      for (const double distance : {0.0, 1e-17, 1e-9, 1e-5, 0.01, 0.5}) {
        for (const double u : {0.0, 0.3, 1.0}) {
          const dvec3 expected = glm::normalize(net_point(net, u, 1.0 - distance) / radius);
          const double error = angle(unit_normal(net, u, 1.0 - distance), expected);
          worst.add(error, sphere_tolerance,
                    [&] { return fmt::format("radius {}, ({}, 1 - {}): {}", radius, u, distance, error); });
        }
      }
      CHECK(glm::length(unit_normal(net, 0.3, 1.0) - dvec3(0.0, 0.0, side)) < 1e-10);
      const NormalCone cone = normal_cone(net);
      // The normals of an octant are within acos(1 / sqrt(3)) of its middle; the coefficients go further.
      CHECK(cone.cos_angle > 0.4);
      CHECK(angle(cone.axis, dvec3(1.0, 1.0, side) / std::sqrt(3.0)) < 0.2);
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("the octant far from its frame's zero keeps the normal at the pole", "[bezier][normal]") {
  WorstCase worst;
  for (const double offset : {1e2, 1e4, 1e5, 1e6}) {
    for (const double radius : {1e-7, 1.0, 1e14}) {
      dmat4 map(radius);
      map[3] = dvec4(radius * offset * dvec3(1.0, -0.7, 0.9), 1.0);
      const Net net = transformed(octant(), map);
      for (const double u : {0.0, 0.3, 0.5, 1.0}) {
        // Rounding moves the control points by eps/2 offset radii. The row of coefficients that gives the
        // normal has products of one such error with two coordinates of size 1, some tens of them over a
        // value of about 1: 1e-8 at 1e6 is 90 of those errors.
        const double error = glm::length(unit_normal(net, u, 1.0) - dvec3(0.0, 0.0, 1.0));
        worst.add(error, 1e-14 * offset,
                  [&] { return fmt::format("offset {}, radius {}, u {}: {}", offset, radius, u, error); });
      }
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("a corner where both tangents vanish has the limit along the diagonal", "[bezier][normal]") {
  NetMaker make(14);
  WorstCase worst;
  for (int k = 0; k < 40; ++k) {
    const bool triangle = k % 2 == 1;
    Net net = triangle ? Net(make.triangle(3)) : Net(make.tensor(2 + k % 3, 2 + k % 4));
    dvec4* p = points_of(net).data();
    // At the frame's zero, where even the point vanishes, and elsewhere.
    if (k % 4 < 2) p[0] = dvec4(0.0, 0.0, 0.0, 1.0);
    p[1] = p[0];
    p[triangle ? triangle_index(3, 1, 0) : std::get<TensorNet>(net).n + 1] = p[0];
    const dvec3 corner = unit_normal(net, 0.0, 0.0);
    // The limit depends on the direction; along the diagonal what is next to it is of relative size 1e-6,
    // times the ratio of the coefficients.
    const double error = glm::length(corner - unit_normal(net, 1e-6, 1e-6));
    worst.add(error, 1e-4, [&] { return fmt::format("net {}: {}", k, error); });
    const oracle::Big tiny("1e-12");
    const double exact = glm::length(corner - oracle::normal(net, tiny, tiny));
    worst.add(exact, 1e-9, [&] { return fmt::format("net {}, against 50 digits: {}", k, exact); });
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("a net collapsed to one point has the normal zero", "[bezier][normal]") {
  NetMaker make(15);
  for (const dvec3& at :
       {dvec3(0.0), dvec3(1.0, -2.0, 0.3), dvec3(1e9, 0.1, 7e8), dvec3(0.0, 3e-200, 1e-200)}) {
    // Weights that differ, so that the products with the point are rounded differently too.
    for (Net net : {Net(make.tensor(2, 3)), Net(make.triangle(3)), Net(make.triangle(1))}) {
      for (dvec4& p : points_of(net)) p = dvec4(p.w * at, p.w);
      for (const double u : {0.0, 0.3, 1.0}) CHECK(unit_normal(net, u, 0.0) == dvec3(0.0));
      CHECK(unit_normal(net, 0.2, 0.4) == dvec3(0.0));
      CHECK(normal_cone(net).cos_angle == -1.0);
    }
  }
}

TEST_CASE("a patch without area has no normal", "[bezier][normal]") {
  TensorNet line(1, 1);
  line.points = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1}};
  CHECK(unit_normal(Net(line), 0.3, 0.4) == dvec3(0.0));
  CHECK(normal_cone(Net(line)).cos_angle == -1.0);
}

}  // namespace rondure
