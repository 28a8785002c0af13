// The fundamental forms, curvatures and reduced normals of patches as polynomials: against tabulated ones,
// pointwise differential geometry and closed forms.
#include "renderer/bezier/curvature_polynomial.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/bezier/common_factor.h"
#include "renderer/bezier/rational.h"
#include "renderer/bezier/transform.h"
#include "renderer/projective/stereographic.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/reference_data.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using Tensor = TensorPolynomial<double>;
using json = nlohmann::json;

json tables() { return reference_data("cobb_curvature.json"); }

Tensor read_tensor(const json& rows) {
  Tensor p(static_cast<int>(rows.size()) - 1, static_cast<int>(rows[0].size()) - 1);
  for (int i = 0; i <= p.m; ++i) {
    for (int j = 0; j <= p.n; ++j)
      p.at(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  }
  return p;
}

// The stereographic image of [-1, 1]^2, degree (2, 2), normals inward.
TensorNet square() {
  PlanarMap<Tensor> g{Tensor(1, 1), Tensor(1, 1), Tensor(1, 1)};
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      g.x.at(i, j) = 2.0 * i - 1.0;
      g.y.at(i, j) = 2.0 * j - 1.0;
      g.w.at(i, j) = 1.0;
    }
  }
  const auto s = to_sphere(g);
  TensorNet net(2, 2);
  for (std::size_t k = 0; k < 9; ++k) {
    for (int c = 0; c < 4; ++c) net.points[k][c] = s[static_cast<std::size_t>(c)].coefficients[k];
  }
  return net;
}

Net patch_of(const std::string& name) {
  if (name == "square1") return square();
  if (name == "octant") return build_family(R"({"type": "sphere_octant", "octants": [0]})").patches[0];
  const std::string topology = name == "hemisphere" ? "hemispheres" : "cube";
  return build_family(R"({"type": "sphere_tiling", "topology": ")" + topology + "\"}").patches[0];
}

double largest(const Tensor& p) {
  double size = 0.0;
  for (const double c : p.coefficients) size = std::max(size, std::abs(c));
  return size;
}

}  // namespace

TEST_CASE("the forms of the stereographic square agree with the tabulated ones", "[bezier][curvature]") {
  const json table = tables()["square1"];
  const CurvaturePolynomials forms = curvature_polynomials(square());
  const std::pair<const char*, const ScalarPolynomial*> all[] = {
      {"d_uu", &forms.d_uu},         {"d_uv", &forms.d_uv},
      {"d_vv", &forms.d_vv},         {"normal_square", &forms.normal_square},
      {"gaussian", &forms.gaussian}, {"mean", &forms.mean}};
  WorstCase worst;
  NetMaker make(61);
  for (const auto& [name, computed] : all) {
    // The tables are raised to degrees of their own: the values are what can be compared.
    const Tensor expected = read_tensor(table[name]);
    const double size = std::max(largest(expected), 1.0);
    for (int k = 0; k < 40; ++k) {
      const double u = make.uniform(0.0, 1.0), v = make.uniform(0.0, 1.0);
      const double error = polynomial_value(*computed, u, v) - polynomial_value(expected, u, v);
      // Integers below 2^53 and some tens of operations; de Casteljau's 36 steps round once each.
      worst.add(std::abs(error) / size, 36 * 0x1p-52,
                [&, name = name] { return fmt::format("{} ({}, {}): {}", name, u, v, error); });
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
  CHECK(std::get<Tensor>(forms.d_uu).m == 2);
  CHECK(std::get<Tensor>(forms.d_uu).n == 6);
  CHECK(std::get<Tensor>(forms.gaussian).m == 16);
}

TEST_CASE("curvature from polynomials is curvature from derivatives", "[bezier][curvature]") {
  NetMaker make(62);
  WorstCase worst;
  for (int k = 0; k < 36; ++k) {
    const int m = 1 + k % 4, n = 1 + k / 2 % 5;
    const double sign = k % 5 == 0 ? -1.0 : 1.0;
    // Nearly flat nets, so that the normal's length stays away from zero.
    TensorNet tensor(m, n);
    for (int i = 0; i <= m; ++i) {
      for (int j = 0; j <= n; ++j) {
        const double w = sign * make.uniform(0.8, 1.25);
        tensor.at(i, j) = {w * i / m, w * j / n, w * make.uniform(-0.3, 0.3), w};
      }
    }
    TriangleNet triangle(n);
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n - i; ++j) {
        const double w = sign * make.uniform(0.8, 1.25);
        triangle.at(i, j) = {w * i / n, w * j / n, w * make.uniform(-0.3, 0.3), w};
      }
    }
    for (const Net& net : {Net(tensor), Net(triangle)}) {
      const CurvaturePolynomials forms = curvature_polynomials(net);
      const dvec2 at = make.in_triangle();
      const SurfaceJet s = surface_jet(net, at.x, at.y);
      const dvec3 normal = glm::normalize(glm::cross(s.du, s.dv));
      const double e = glm::dot(s.du, s.du), f = glm::dot(s.du, s.dv), g = glm::dot(s.dv, s.dv);
      const double l = glm::dot(s.duu, normal), mm = glm::dot(s.duv, normal), h = glm::dot(s.dvv, normal);
      const double area = e * g - f * f;
      const double gaussian = (l * h - mm * mm) / area, mean = (e * h - 2 * f * mm + g * l) / (2 * area);
      const double nn = polynomial_value(forms.normal_square, at.x, at.y);
      const double computed = polynomial_value(forms.gaussian, at.x, at.y) / (nn * nn);
      const double bent = sign * polynomial_value(forms.mean, at.x, at.y) / (2 * std::pow(nn, 1.5));
      // Curvatures of some tens; the numerators are sums of 10^4 terms whose size is a few times the value.
      const double scale = 1.0 + mean * mean;
      const auto add = [&](double error, const char* what) {
        worst.add(std::abs(error) / scale, 2e-12,
                  [&] { return fmt::format("{} of net {}: {}", what, k, error); });
      };
      add(computed - gaussian, "Gaussian");
      add(bent - mean, "mean");
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("polynomials of spheres have the curvature of spheres", "[bezier][curvature]") {
  WorstCase worst;
  NetMaker make(63);
  for (const char* name : {"cube_face", "hemisphere", "octant"}) {
    for (const double radius : {0.25, 3.0}) {
      const Net net = transformed(patch_of(name), dmat4(glm::dmat3(radius)));
      const CurvaturePolynomials forms = curvature_polynomials(net);
      for (int k = 0; k < 30; ++k) {
        const double u = make.uniform(0.05, 0.95), v = make.uniform(0.05, 0.95);
        const double nn = polynomial_value(forms.normal_square, u, v);
        const double gaussian = polynomial_value(forms.gaussian, u, v) / (nn * nn) * radius * radius;
        const double mean = polynomial_value(forms.mean, u, v) / (2 * std::pow(nn, 1.5)) * radius;
        const double error = std::max(std::abs(gaussian - 1.0), std::abs(mean + 1.0));
        // Near a singular corner N.N falls to the square of a tenth of its largest: its square to 1e-4.
        worst.add(error, 1e-10, [&] { return fmt::format("{} ({}, {}): {}", name, u, v, error); });
      }
    }
  }
  INFO(worst.text());
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("a normal on the sphere is the point times the tabulated Jacobian", "[bezier][normal]") {
  const json table = tables();
  WorstCase worst, values;
  for (const char* name : {"cube_face", "hemisphere", "octant", "square1"}) {
    const Net net = patch_of(name);
    const auto& points = std::get<TensorNet>(net).points;
    const ReducedNormal reduced = reduced_normal(normal_polynomial(net));
    const Tensor expected = read_tensor(table[name]["factor"]);
    const auto& direction = std::get<TensorPolynomial<dvec3>>(reduced.direction);
    const auto& factor = std::get<Tensor>(reduced.factor);
    INFO(name);
    // The octant's last column, at the pole, is its own factor 1 - v of J.
    REQUIRE(direction.m == std::get<TensorNet>(net).m);
    REQUIRE(direction.n == std::get<TensorNet>(net).n);
    REQUIRE(factor.m == expected.m);
    REQUIRE(factor.n == expected.n);
    double size = 0.0;
    for (const dvec4& p : points) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    // J of the square is negative: its normals point inward, and so does the reduced normal.
    const double sign = std::string(name) == "square1" ? -1.0 : 1.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double error = glm::length(direction.coefficients[k] - sign * dvec3(points[k]) / size);
      // A product determines its factors less well than its values: by the rounding of N, 25 eps, over the
      // ratio of the least singular values, some 1e-5.
      worst.add(error, 2e-9, [&] { return fmt::format("direction of {}: {}", name, error); });
    }
    NetMaker make(65);
    for (int k = 0; k < 50; ++k) {
      const double u = k % 10 == 0 ? 0.0 : make.uniform(0.0, 1.0),
                   v = k % 20 == 0 ? 0.0 : make.uniform(0.0, 1.0);
      const dvec3 n = glm::normalize(polynomial_value(reduced.direction, u, v));
      const double error = glm::length(n - sign * net_point(net, u, v));
      // The values do not feel that, at the singular corners neither.
      values.add(error, 1e-13, [&] { return fmt::format("{} ({}, {}): {}", name, u, v, error); });
    }
    for (std::size_t k = 0; k < factor.coefficients.size(); ++k) {
      const double error = factor.coefficients[k] / size - sign * expected.coefficients[k];
      worst.add(std::abs(error) / largest(expected), 2e-9,
                [&] { return fmt::format("factor of {}: {}", name, error); });
    }
    worst.add(reduced.residual, 1e-13,
              [&] { return fmt::format("residual of {}: {}", name, reduced.residual); });
  }
  INFO(worst.text());
  INFO(values.text());
  CHECK(values.failures() == 0);
  REQUIRE(worst.failures() == 0);
}

TEST_CASE("normals lose the factors that they have, and no others", "[bezier][normal]") {
  NetMaker make(64);
  const auto degrees = [](const Net& net) {
    const ReducedNormal r = reduced_normal(normal_polynomial(net));
    CHECK(r.residual < 1e-12);
    if (const auto* t = std::get_if<TensorPolynomial<dvec3>>(&r.direction)) return std::pair(t->m, t->n);
    return std::pair(std::get<TrianglePolynomial<dvec3>>(r.direction).n, -1);
  };
  // A patch in general position has none: (3m - 2, 3n - 2) and 3n - 3.
  CHECK(degrees(make.tensor(2, 3)) == std::pair(4, 7));
  CHECK(degrees(make.triangle(3)) == std::pair(6, -1));
  // A plane's normal is constant, whatever its parametrisation.
  TensorNet flat = make.tensor(3, 2);
  for (dvec4& p : flat.points) p.z = 0.5 * p.x + 0.25 * p.w;
  CHECK(degrees(flat) == std::pair(0, 0));
  TriangleNet flat_triangle = make.triangle(4);
  for (dvec4& p : flat_triangle.points) p.z = 0.5 * p.x + 0.25 * p.w;
  CHECK(degrees(flat_triangle) == std::pair(0, -1));
  // Under a projective map of the sphere the tangent plane stays a matrix times the point.
  dmat4 map(1.0);
  map[0] = {1.0, 0.2, 0.1, 0.15};
  map[1] = {-0.3, 0.8, 0.0, 0.1};
  CHECK(degrees(transformed(patch_of("cube_face"), map)) == std::pair(4, 4));
  // A bilinear map inside a biquadratic patch brings in its own Jacobian, (1, 1) besides the least (8, 8).
  PlanarMap<Tensor> g{Tensor(1, 1), Tensor(1, 1), Tensor(1, 1)};
  g.x.coefficients = {0.1, 0.2, 0.9, 0.7};
  g.y.coefficients = {0.1, 0.8, 0.2, 0.9};
  g.w.coefficients = {1.0, 1.0, 1.0, 1.0};
  const TensorNet inner = compose(make.tensor(1, 1), g);
  REQUIRE(inner.m == 2);
  CHECK(degrees(inner) == std::pair(2, 2));
  // Twice the same collapsed edge.
  TensorNet cone = make.tensor(2, 2);
  for (int i = 0; i <= 2; ++i) cone.at(i, 2) = {0, 0, 1, 1};
  CHECK(degrees(cone) == std::pair(4, 3));
}

}  // namespace rondure
