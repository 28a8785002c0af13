// Evaluation of nets of degree 1 to 12 against the definition in 50 digits.
#include <fmt/format.h>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/rational.h"
#include "renderer/bezier/triangle.h"
#include "renderer/intersect/cell.h"
#include "tests/bezier/oracle.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using oracle::Big;

// A basis function is good to (n + 2) epsilon; a sum over a few terms adds about one epsilon a level.
// Derivatives of order k sum differences of control points with factors up to (2 n)^k. Outside [0, 1] by 1%
// the sum of |B_i| is below 1.02^24 < 1.7. Control points are below 1.5.
double tolerance(int degree, int order) {
  return 2.6 * (degree + 8) * epsilon * std::pow(2.0 * degree, order);
}

template <class N>
void compare(const N& net, int degree, double u, double v, const FirstOrder<dvec4>& f,
             const SecondOrder<dvec4>& s, const dvec4& value, WorstCase& worst) {
  const struct {
    dvec4 computed;
    int a, b;
  } all[] = {{value, 0, 0}, {f.value, 0, 0}, {f.du, 1, 0},  {f.dv, 0, 1},  {s.value, 0, 0},
             {s.du, 1, 0},  {s.dv, 0, 1},    {s.duu, 2, 0}, {s.duv, 1, 1}, {s.dvv, 0, 2}};
  for (const auto& [computed, a, b] : all) {
    const double error = oracle::distance(computed, oracle::derivative(net, a, b, u, v));
    worst.add(error, tolerance(degree, a + b), [&, a = a, b = b] {
      return fmt::format("degree {}, order ({}, {}), at ({}, {}): {}", degree, a, b, u, v, error);
    });
  }
}

}  // namespace

TEST_CASE("tensor nets of degree 1 to 12 evaluate as defined", "[bezier]") {
  NetMaker make(1);
  WorstCase worst;
  for (int m = 1; m <= 12; ++m) {
    for (int n = 1; n <= 12; ++n) {
      const TensorNet net = make.tensor(m, n);
      const double at[][2] = {{make.uniform(0.0, 1.0), make.uniform(0.0, 1.0)},
                              {make.uniform(-0.01, 1.01), make.uniform(-0.01, 1.01)},
                              {(m + n) % 2 == 0 ? 0.0 : 1.0, n % 2 == 0 ? 0.0 : 1.0}};
      for (const auto& [u, v] : at) {
        const dvec4* p = net.points.data();
        for (const SecondOrder<dvec4>& second :
             {tensor_second(p, m, n, u, v), tensor_second_by_sums(p, m, n, u, v)})
          compare(net, m + n, u, v, tensor_first(p, m, n, u, v), second, tensor_value(p, m, n, u, v), worst);
      }
    }
  }
  INFO(worst.text());
  CHECK(worst.count() == 144 * 3 * 2 * 10);
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("compile-time degrees evaluate as defined", "[bezier]") {
  NetMaker make(2);
  WorstCase worst;
  const int degrees[][2] = {{2, 2}, {2, 4}, {4, 2}, {4, 4}};
  for (const auto& [m, n] : degrees) {
    const Net net = make.tensor(m, n);
    const auto& tensor = std::get<TensorNet>(net);
    for (int k = 0; k < 40; ++k) {
      const double u = make.uniform(-0.01, 1.01);
      const double v = make.uniform(-0.01, 1.01);
      const FirstOrder<dvec4> f = net_first(net, u, v);
      const SecondOrder<dvec4> sums = TensorShape{m, n}.second(tensor.points.data(), dvec2(u, v));
      for (const SecondOrder<dvec4>& second : {net_second(net, u, v), sums})
        compare(tensor, m + n, u, v, f, second, f.value, worst);
    }
  }
  for (int n = 1; n <= 6; ++n) {
    const Net net = make.triangle(n);
    for (int k = 0; k < 40; ++k) {
      const dvec2 p = make.in_triangle();
      const FirstOrder<dvec4> f = net_first(net, p.x, p.y);
      compare(std::get<TriangleNet>(net), n, p.x, p.y, f, net_second(net, p.x, p.y), f.value, worst);
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("triangular nets of degree 1 to 12 evaluate as defined", "[bezier]") {
  NetMaker make(3);
  WorstCase worst;
  for (int n = 1; n <= 12; ++n) {
    const TriangleNet net = make.triangle(n);
    const dvec4* p = net.points.data();
    for (int k = 0; k < 12; ++k) {
      dvec2 at = make.in_triangle();
      if (k == 0) at = {1.0, 0.0};
      if (k == 1) at = {0.0, 1.0};
      if (k == 2) at = {0.0, 0.0};
      if (k == 3) at = {-0.01, 0.5};
      compare(net, n, at.x, at.y, triangle_first(p, n, at.x, at.y), triangle_second(p, n, at.x, at.y),
              triangle_value(p, n, at.x, at.y), worst);
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("every coefficient type gives the same bits", "[bezier]") {
  NetMaker make(4);
  const TensorNet net = make.tensor(4, 4);
  std::vector<double> scalars;
  std::vector<dvec2> pairs;
  std::vector<dvec3> triples;
  for (const dvec4& p : net.points) {
    scalars.push_back(p.x);
    pairs.emplace_back(p.x, p.y);
    triples.emplace_back(p.x, p.y, p.z);
  }
  int differ = 0;
  for (int k = 0; k < 100; ++k) {
    const double u = make.uniform(0.0, 1.0);
    const double v = make.uniform(0.0, 1.0);
    const auto four = tensor_first<4, 4>(net.points.data(), 4, 4, u, v);
    const auto one = tensor_first(scalars.data(), 4, 4, u, v);
    const auto two = tensor_first<4, 4>(pairs.data(), 4, 4, u, v);
    const auto three = tensor_first<4, 4>(triples.data(), 4, 4, u, v);
    for (const bool same : {one.value == four.value.x, one.du == four.du.x, one.dv == four.dv.x,
                            two.du == dvec2(four.du), two.dv == dvec2(four.dv), three.dv == dvec3(four.dv)}) {
      if (!same) ++differ;
    }
  }
  REQUIRE(differ == 0);
}

TEST_CASE("a net of degree 0 is constant", "[bezier]") {
  const dvec2 point(3.0, -2.0);
  const auto f = tensor_second(&point, 0, 0, 0.3, 0.7);
  CHECK(f.value == point);
  CHECK(f.du == dvec2(0.0));
  CHECK(f.dvv == dvec2(0.0));
  CHECK(tensor_first(&point, 0, 0, 0.3, 0.7).dv == dvec2(0.0));
  CHECK(triangle_first(&point, 0, 0.3, 0.2).du == dvec2(0.0));
}

TEST_CASE("the largest degree evaluates", "[bezier]") {
  NetMaker make(5);
  WorstCase worst;
  const TensorNet net = make.tensor(max_degree, max_degree);
  const TriangleNet triangle = make.triangle(max_degree);
  const dvec4* p = net.points.data();
  const dvec4* q = triangle.points.data();
  compare(net, 2 * max_degree, 0.37, 0.61, tensor_first(p, max_degree, max_degree, 0.37, 0.61),
          tensor_second(p, max_degree, max_degree, 0.37, 0.61),
          tensor_value(p, max_degree, max_degree, 0.37, 0.61), worst);
  compare(triangle, max_degree, 0.37, 0.21, triangle_first(q, max_degree, 0.37, 0.21),
          triangle_second(q, max_degree, 0.37, 0.21), triangle_value(q, max_degree, 0.37, 0.21), worst);
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

}  // namespace rondure
