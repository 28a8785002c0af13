// Images of nets under delta and its ruled counterpart: identities, degrees, base points.
#include "renderer/projective/preimage.h"

#include <fmt/format.h>

#include <glm/matrix.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/triangle.h"
#include "renderer/projective/orientation.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

TensorPreimage random_tensor(NetMaker& make, int m, int n) {
  TensorPreimage p(m, n);
  for (lvec4& c : p.coefficients) c = make.point(-1.0, 1.0);
  return p;
}

TrianglePreimage random_triangle(NetMaker& make, int n) {
  TrianglePreimage p(n);
  for (lvec4& c : p.coefficients) c = make.point(-1.0, 1.0);
  return p;
}

template <class N>
auto polynomial_of(const N& net) {
  using Lvecs = std::vector<lvec4>;
  if constexpr (std::is_same_v<N, TensorNet>) {
    return TensorPolynomial<lvec4>(net.m, net.n, Lvecs(net.points.begin(), net.points.end()));
  } else {
    return TrianglePolynomial<lvec4>(net.n, Lvecs(net.points.begin(), net.points.end()));
  }
}

// The largest coefficient of x^T B x relative to those of B and the square of the largest control point.
double residual(const Net& net, const lmat4& matrix) {
  long double most = 0, scale = 0, size = 0;
  for (int k = 0; k < 16; ++k) size = std::max(size, std::abs(matrix[k / 4][k % 4]));
  for (const dvec4& p : points_of(net)) scale = std::max(scale, static_cast<long double>(glm::dot(p, p)));
  std::visit(
      [&](const auto& n) {
        const auto x = polynomial_of(n);
        const auto form =
            multiply(x, x, [&](const lvec4& a, const lvec4& b) { return glm::dot(a, matrix * b); });
        for (const long double c : form.coefficients) most = std::max(most, std::abs(c));
      },
      net);
  return static_cast<double>(most / (size * scale));
}

lvec4 value(const TensorPreimage& p, double u, double v) {
  std::vector<dvec4> c(p.coefficients.begin(), p.coefficients.end());
  return tensor_value(c.data(), p.m, p.n, u, v);
}

}  // namespace

TEST_CASE("images lie on their quadric as a polynomial identity", "[projective]") {
  NetMaker make(31);
  WorstCase worst;
  constexpr QuadricKind kinds[] = {QuadricKind::ellipsoid, QuadricKind::two_sheets, QuadricKind::one_sheet,
                                   QuadricKind::elliptic_paraboloid, QuadricKind::hyperbolic_paraboloid};
  for (int k = 0; k < 200; ++k) {
    const Quadric quadric{
        kinds[k % 5], {make.uniform(0.5, 2), make.uniform(0.5, 2), make.uniform(0.5, 2)}, lmat4(1)};
    const int m = 1 + k / 5 % 3, n = 1 + k % 4;
    Preimage preimage;
    if (k % 2 == 0) {
      preimage = random_tensor(make, m, n);
    } else {
      preimage = random_triangle(make, n);
    }
    const Net net = quadric_image(preimage, quadric);
    if (const auto* t = std::get_if<TensorNet>(&net)) {
      CHECK((t->m == 2 * m && t->n == 2 * n));
    } else {
      CHECK(std::get<TriangleNet>(net).n == 2 * n);
    }
    // A coefficient is a mean of products with weights that add up to 1, each of two points rounded by half
    // an ulp: 2 * 4 entries * 2^-53 relative to |B| |x|^2.
    worst.add(residual(net, matrix_of(quadric)), 0x1p-50, [&] { return fmt::format("net {}", k); });
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("the image of a net is the image of its points", "[projective]") {
  NetMaker make(32);
  WorstCase worst;
  for (int k = 0; k < 100; ++k) {
    const TensorPreimage p = random_tensor(make, 1 + k % 3, 1 + k % 2);
    const Net net = sphere_image(p);
    const double u = make.uniform(0, 1), v = make.uniform(0, 1);
    const lvec4 x = delta(value(p, u, v));
    const dvec3 expected = dvec3(lvec3(x) / x.w);
    // Sums of terms up to 4 over a weight that may be small.
    worst.add(glm::distance(net_point(net, u, v), expected), 1e-14 / double(x.w),
              [&] { return fmt::format("net {}", k); });
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("base points are found where they are, and nowhere else", "[projective]") {
  NetMaker make(33);
  for (int k = 0; k < 40; ++k) {
    // Four numbers that vanish together at one place only by design.
    TensorPreimage p = random_tensor(make, 2, 3);
    CHECK(base_points(p, false, 8).empty());
    const double u = make.uniform(0.1, 0.9), v = make.uniform(0.1, 0.9);
    const lvec4 shift = value(p, u, v);
    for (lvec4& c : p.coefficients) c -= shift;
    const std::vector<dvec2> found = base_points(p, false, 8);
    REQUIRE(found.size() == 1);
    CHECK(glm::distance(found[0], dvec2(u, v)) < 1e-8);
    TrianglePreimage t = random_triangle(make, 2);
    CHECK(base_points(t, false, 8).empty());
    std::vector<dvec4> c(t.coefficients.begin(), t.coefficients.end());
    const dvec2 at = make.in_triangle();
    for (lvec4& b : t.coefficients) b -= lvec4(triangle_value(c.data(), 2, at.x, at.y));
    const std::vector<dvec2> in_triangle = base_points(t, false, 8);
    REQUIRE(in_triangle.size() == 1);
    CHECK(glm::distance(in_triangle[0], at) < 1e-8);
  }
  // At a corner, and on an edge.
  TensorPreimage corner(1, 1, {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}});
  CHECK(base_points(corner, false, 8) == std::vector<dvec2>{dvec2(0x1p-31)});
  TensorPreimage edge(1, 1, {{1, 0, 0, 0}, {-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}});
  REQUIRE(base_points(edge, false, 8).size() == 1);
  CHECK(glm::distance(base_points(edge, false, 8)[0], dvec2(0.0, 0.5)) < 1e-8);
  // A whole line of them ends at the limit.
  TensorPreimage line(1, 1, {{-1, 0, 0, 0}, {-1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}});
  CHECK(base_points(line, false, 5).size() == 5);
  // On ruled quadrics a pair is enough: p0 = p1 = 0 at (1/2, 1/2).
  TensorPreimage ruled(1, 1, {{-1, -1, 1, 2}, {-1, 1, 1, 2}, {1, -1, 1, 2}, {1, 1, 1, 2}});
  REQUIRE(base_points(ruled, true, 8).size() == 1);
  CHECK(glm::distance(base_points(ruled, true, 8)[0], dvec2(0.5, 0.5)) < 1e-8);
  CHECK(base_points(ruled, false, 8).empty());
}

TEST_CASE("nets on the sphere have preimages (theorem 2.2)", "[projective]") {
  NetMaker make(35);
  WorstCase worst;
  int none = 0;
  for (int k = 0; k < 60; ++k) {
    Preimage given;
    if (k % 2 == 0) {
      given = random_tensor(make, 1 + k / 2 % 3, 1 + k / 6 % 2);
    } else {
      given = random_triangle(make, 1 + k / 2 % 3);
    }
    Net net = sphere_image(given);
    if (k % 5 == 0) {
      for (dvec4& p : points_of(net)) p = -p;
    }
    const std::optional<Preimage> found = sphere_preimage(net);
    none += !found;
    if (!found) continue;
    const Net again = sphere_image(*found);
    double largest = 0.0;
    for (const dvec4& p : points_of(net)) largest = std::max(largest, glm::length(p));
    for (std::size_t i = 0; i < points_of(net).size(); ++i) {
      const dvec4 expected = (k % 5 == 0 ? -1.0 : 1.0) * points_of(net)[i];
      // The net's rounding, 2^-53, conditioned by the linear system.
      worst.add(glm::length(points_of(again)[i] - expected), 1e-10 * largest,
                [&] { return fmt::format("net {}", k); });
    }
  }
  INFO(worst.text());
  CHECK(none == 0);
  CHECK(worst.failures() == 0);
  // Off the sphere, of odd degree, with a common factor.
  CHECK_FALSE(sphere_preimage(make.tensor(2, 2)).has_value());
  CHECK_FALSE(sphere_preimage(make.tensor(2, 3)).has_value());
  CHECK_FALSE(sphere_preimage(make.triangle(1)).has_value());
  const TensorPreimage p = random_tensor(make, 1, 1);
  const TensorPolynomial<long double> factor(1, 1, {1, 2, 3, 4});
  const auto scaled = multiply(p, factor, [](const lvec4& a, long double b) { return b * a; });
  CHECK_FALSE(sphere_preimage(sphere_image(scaled)).has_value());
}

TEST_CASE("the orientation is the Jacobian of the image", "[projective]") {
  NetMaker make(34);
  WorstCase worst;
  for (int k = 0; k < 100; ++k) {
    const double u = make.uniform(0, 0.5), v = make.uniform(0, 0.5);
    Preimage preimage;
    double j = 0.0;
    const auto take = [&](const auto& p, const auto& evaluate) {
      preimage = p;
      const auto polynomial = orientation(p);
      const std::vector<double> c(polynomial.coefficients.begin(), polynomial.coefficients.end());
      j = evaluate(polynomial, c);
    };
    if (k % 2 == 0) {
      take(random_tensor(make, 1 + k % 3, 2),
           [&](const auto& q, const auto& c) { return tensor_value(c.data(), q.m, q.n, u, v); });
    } else {
      take(random_triangle(make, 1 + k % 3),
           [&](const auto& q, const auto& c) { return triangle_value(c.data(), q.n, u, v); });
    }
    const Net net = sphere_image(preimage);
    const SurfaceJet jet = surface_jet(net, u, v);
    const double w = net_first(net, u, v).value.w;
    const double expected = glm::dot(glm::cross(jet.du, jet.dv), jet.point);
    worst.add(std::abs(j / (w * w) - expected), 1e-11 * (1 + std::abs(expected)) / (w * w * w),
              [&] { return fmt::format("net {}: {} for {}", k, j / (w * w), expected); });
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("regularity is proved or refuted", "[projective]") {
  // The reference's bilinear patch; its mirror image faces inward; one that folds.
  const TensorPreimage good(1, 1, {{1, 0, 0, 0}, {1, 1, 0, 0.5L}, {1, 0, 1, 1 / 3.0L}, {1, 1, 1, 0}});
  const TensorPreimage bad(1, 1, {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 0, 1, 0}, {1, -1, -1, 0}});
  const TensorPreimage inward(1, 1, {good.at(1, 0), good.at(1, 1), good.at(0, 0), good.at(0, 1)});
  // u and v are exchanged in these: x grows with v. Seen from outside, at the south pole, x and y are a
  // left-handed pair.
  const bool first = regularity(good).regular, second = regularity(inward).regular;
  CHECK(first != second);
  CHECK(first == (orientation(good).at(0, 0) > 0));
  CHECK_FALSE(regularity(bad).regular);
  const TrianglePreimage forward(1, {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 0, 1, 0}});
  const TrianglePreimage backward(1, {{1, 0, 0, 0}, {1, 0, 1, 0}, {1, 1, 0, 0}});
  CHECK(regularity(forward).regular != regularity(backward).regular);
}

}  // namespace rondure
