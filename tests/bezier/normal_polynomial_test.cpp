// The normal polynomial, and the cones that it bounds.
#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/bezier/normal.h"
#include "renderer/bezier/rational.h"
#include "renderer/bezier/tensor.h"
#include "renderer/bezier/triangle.h"
#include "tests/bezier/cube_face.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/reference_data.h"
#include "tests/worst_case.h"

namespace rondure {

TEST_CASE("the normal polynomial is w (X_u x X_v) and so on, of the true degree", "[bezier][normal]") {
  NetMaker make(12);
  WorstCase worst;
  for (int k = 0; k < 30; ++k) {
    const bool triangle = k % 2 == 1;
    const Net net = triangle ? Net(make.triangle(1 + k % 6)) : Net(make.tensor(1 + k % 4, 1 + k % 5));
    const NormalPolynomial polynomial = normal_polynomial(net);
    for (int sample = 0; sample < 5; ++sample) {
      const dvec2 at = make.in_triangle();
      dvec3 computed;
      if (const auto* t = std::get_if<TensorPolynomial<dvec3>>(&polynomial)) {
        CHECK(t->m == 3 * std::get<TensorNet>(net).m - 2);
        computed = tensor_value(t->coefficients.data(), t->m, t->n, at.x, at.y);
      } else {
        const auto& p = std::get<TrianglePolynomial<dvec3>>(polynomial);
        CHECK(p.n == 3 * std::get<TriangleNet>(net).n - 3);
        computed = triangle_value(p.coefficients.data(), p.n, at.x, at.y);
      }
      const SurfaceJet s = surface_jet(net, at.x, at.y);
      const double w = net_first(net, at.x, at.y).value.w;
      const dvec3 expected = w * w * w * glm::cross(s.du, s.dv);
      // Each coefficient sums products of three points of size 2 with factors of the degree squared.
      const double error = glm::length(computed - expected);
      worst.add(error, 1e-13, [&] { return fmt::format("net {}: {}", k, error); });
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("the normal polynomial of the cube's face agrees with the tabulated one", "[bezier][normal]") {
  const auto expected = reference_data("cobb_derived.json")["cube_face_normal"];
  const auto normals = std::get<TensorPolynomial<dvec3>>(normal_polynomial(cube_face()));
  REQUIRE(normals.m == 10);
  REQUIRE(normals.n == 10);
  WorstCase worst;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10; ++j) {
      for (int c = 0; c < 3; ++c) {
        // Coefficients up to 200 from sums of some hundred terms: 1e-12 is 25 eps of the largest.
        const double error = std::abs(normals.at(i, j)[c] - expected[c][i][j].get<double>());
        worst.add(error, 1e-12, [&] { return fmt::format("({}, {}) {}: {}", i, j, c, error); });
      }
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("normal cones contain the normals and shrink with the patch", "[bezier][normal]") {
  NetMaker make(13);
  WorstCase worst;
  int bounded = 0;
  const auto check = [&](const Net& net, bool triangle) {
    const NormalCone cone = normal_cone(net);
    if (cone.cos_angle <= -1.0) return cone;
    ++bounded;
    for (int k = 0; k < 50; ++k) {
      dvec2 at(make.uniform(0.0, 1.0), make.uniform(0.0, 1.0));
      if (triangle) at = make.in_triangle();
      const double outside = cone.cos_angle - glm::dot(cone.axis, unit_normal(net, at.x, at.y));
      worst.add(std::max(outside, 0.0), 1e-11, [&] { return fmt::format("outside by {}", outside); });
    }
    return cone;
  };
  for (int k = 0; k < 20; ++k) {
    // Nearly flat nets: regular, with normals spread over some tens of degrees.
    TensorNet net(2 + k % 3, 2 + k % 2);
    for (int i = 0; i <= net.m; ++i) {
      for (int j = 0; j <= net.n; ++j) {
        const double w = make.uniform(0.8, 1.2);
        net.at(i, j) = {w * i / net.m, w * j / net.n, make.uniform(-0.1, 0.1), w};
      }
    }
    const NormalCone whole = check(net, false);
    TensorNet part(net.m, net.n);
    tensor_restrict(net.points.data(), net.m, net.n, 0.25, 0.5, 0.5, 0.75, part.points.data());
    const NormalCone smaller = check(part, false);
    CHECK(smaller.cos_angle > whole.cos_angle);
    TriangleNet triangle(2 + k % 4);
    for (int i = 0; i <= triangle.n; ++i) {
      for (int j = 0; j <= triangle.n - i; ++j) {
        const double w = k % 2 == 0 ? make.uniform(0.8, 1.2) : make.uniform(-1.2, -0.8);
        triangle.at(i, j) = {w * i / triangle.n, w * j / triangle.n, make.uniform(-0.1, 0.1), w};
      }
    }
    check(triangle, true);
  }
  INFO(worst.text());
  CHECK(bounded >= 40);
  REQUIRE(worst.failures() == 0);
}

}  // namespace rondure
