// Products and compositions against pointwise ones, and against a tabulated composition.
#include "renderer/bezier/compose.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/tensor.h"
#include "renderer/bezier/triangle.h"
#include "renderer/projective/stereographic.h"
#include "tests/bezier/cube_face.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/reference_data.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using Tensor = TensorPolynomial<double>;
using Triangle = TrianglePolynomial<double>;

Tensor random_tensor(NetMaker& make, int m, int n, double low, double high) {
  Tensor p(m, n);
  for (double& c : p.coefficients) c = make.uniform(low, high);
  return p;
}

Triangle random_triangle(NetMaker& make, int n, double low, double high) {
  Triangle p(n);
  for (double& c : p.coefficients) c = make.uniform(low, high);
  return p;
}

double value(const Tensor& p, dvec2 at) { return tensor_value(p.coefficients.data(), p.m, p.n, at.x, at.y); }
double value(const Triangle& p, dvec2 at) { return triangle_value(p.coefficients.data(), p.n, at.x, at.y); }

// f(X/W, Y/W) as points in space, homogeneous coordinates divided out.
template <class F, class Polynomial>
double composition_error(const F& f, const PlanarMap<Polynomial>& g, dvec2 at) {
  const Net composed = compose(f, g);
  const double w = value(g.w, at);
  const dvec3 expected = net_point(Net(f), value(g.x, at) / w, value(g.y, at) / w);
  return glm::length(net_point(composed, at.x, at.y) - expected);
}

}  // namespace

TEST_CASE("products of polynomials are the products of their values", "[bezier]") {
  NetMaker make(41);
  WorstCase worst;
  for (int k = 0; k < 60; ++k) {
    const int a = k % 7, b = (k / 2) % 7, c = (k / 3) % 7, d = (k / 5) % 7;
    const dvec2 at = make.in_triangle();
    const Tensor p = random_tensor(make, a, b, -1.0, 1.0), q = random_tensor(make, c, d, -1.0, 1.0);
    const Tensor pq = multiply(p, q);
    CHECK(pq.m == a + c);
    CHECK(pq.n == b + d);
    const Triangle s = random_triangle(make, a, -1.0, 1.0), t = random_triangle(make, b, -1.0, 1.0);
    // Coefficients below 1, means of products with positive weights: a few eps for each of up to 12 + 12
    // degrees.
    worst.add(std::abs(value(pq, at) - value(p, at) * value(q, at)), 1e-14,
              [&] { return fmt::format("tensor ({}, {}) ({}, {})", a, b, c, d); });
    worst.add(std::abs(value(multiply(s, t), at) - value(s, at) * value(t, at)), 1e-14,
              [&] { return fmt::format("triangle {} {}", a, b); });
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("compositions are pointwise compositions", "[bezier]") {
  NetMaker make(42);
  WorstCase worst;
  for (int k = 0; k < 24; ++k) {
    const TensorNet f = make.tensor(1 + k % 4, 1 + k % 3);
    const TriangleNet h = make.triangle(1 + k % 5);
    const int p = 1 + k % 2, q = 1 + k % 3;
    // X <= W / 2 and Y <= W / 2 keep the image in the domain of both kinds.
    const PlanarMap<Tensor> g{random_tensor(make, p, q, 0.0, 0.5), random_tensor(make, p, q, 0.0, 0.5),
                              random_tensor(make, p, q, 1.0, 1.5)};
    const PlanarMap<Triangle> t{random_triangle(make, q, 0.0, 0.5), random_triangle(make, q, 0.0, 0.5),
                                random_triangle(make, q, 1.0, 1.5)};
    const dvec2 at = make.in_triangle();
    const auto add = [&](double error, const char* what) {
      // The weights of the composition come close to (1.5)^7 while values stay near 1: some tens of eps.
      worst.add(error, 1e-14, [&] { return fmt::format("{} {}: {}", what, k, error); });
    };
    add(composition_error(f, g, at), "tensor o tensor");
    add(composition_error(f, t, at), "tensor o triangle");
    add(composition_error(h, g, at), "triangle o tensor");
    add(composition_error(h, t, at), "triangle o triangle");
    CHECK(compose(f, g).m == (f.m + f.n) * p);
    CHECK(compose(h, t).n == h.n * q);
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("the tabulated part of the cube's face is the composition", "[bezier]") {
  const auto table = reference_data("cobb_derived.json");
  PlanarMap<Tensor> g{Tensor(1, 1), Tensor(1, 1), Tensor(1, 1)};
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      g.x.at(i, j) = number(table["planar"][i][j][0]);
      g.y.at(i, j) = number(table["planar"][i][j][1]);
      g.w.at(i, j) = number(table["planar"][i][j][2]);
    }
  }
  const TensorNet composed = compose(cube_face(), g);
  REQUIRE(composed.m == 8);
  REQUIRE(composed.n == 8);
  WorstCase worst;
  for (int i = 0; i <= 8; ++i) {
    for (int j = 0; j <= 8; ++j) {
      for (int c = 0; c < 4; ++c) {
        // Coefficients below 5: 25 sums, each good to some eps.
        const double error = std::abs(composed.at(i, j)[c] - table["composed"][i][j][c].get<double>());
        worst.add(error, 2e-14, [&] { return fmt::format("({}, {}) {}: {}", i, j, c, error); });
      }
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("inverse stereographic projection lands on the sphere where it should", "[bezier]") {
  NetMaker make(43);
  WorstCase worst;
  for (int k = 0; k < 20; ++k) {
    const PlanarMap<Triangle> g{random_triangle(make, 2, -3.0, 3.0), random_triangle(make, 2, -3.0, 3.0),
                                random_triangle(make, 2, 0.5, 1.5)};
    const auto s = to_sphere(g);
    const dvec2 at = make.in_triangle();
    const double x = value(g.x, at) / value(g.w, at), y = value(g.y, at) / value(g.w, at);
    // The line from the north pole (0, 0, 1) to (x, y, -1) meets the sphere again at this point.
    const double t = 4.0 / (x * x + y * y + 4.0);
    const dvec3 expected(t * x, t * y, 1.0 - 2.0 * t);
    const dvec3 point = dvec3(value(s[0], at), value(s[1], at), value(s[2], at)) / value(s[3], at);
    const double error = glm::length(point - expected);
    // Weights of up to (9 + 9 + 9) around a value of at least 1.
    worst.add(error, 1e-14, [&] { return fmt::format("{}", error); });
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

}  // namespace rondure
