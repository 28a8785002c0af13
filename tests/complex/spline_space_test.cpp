// Dimensions and bases of spaces of geometrically continuous functions.
#include "renderer/complex/spline_space.h"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

#include "renderer/api/patch.h"
#include "renderer/complex/gc_function.h"
#include "renderer/complex/octahedron_bases.h"
#include "renderer/complex/regular_joins.h"
#include "renderer/complex/shipped.h"
#include "tests/catch.h"

namespace rondure {
namespace {

// "3 5 5 3 ..." : corners P, Q, R, then along PQ, QR, RP, then the middle, of a cubic.
std::string listed(const PolygonPolynomial& p) {
  static constexpr int order[10][2] = {{3, 0}, {0, 3}, {0, 0}, {2, 1}, {1, 2},
                                       {0, 2}, {0, 1}, {1, 0}, {2, 0}, {1, 1}};
  std::string text;
  for (const auto& e : order) {
    const Exact& c = p.coefficients[static_cast<std::size_t>(triangle_index(3, e[0], e[1]))];
    text += (text.empty() ? "" : " ") + c.str();
  }
  return text;
}

// Integral over all triangles, each of area 1: the mean of the Bernstein coefficients.
Exact scalar_product(const std::vector<PolygonPolynomial>& f, const std::vector<PolygonPolynomial>& g) {
  Exact sum = 0;
  for (std::size_t p = 0; p < f.size(); ++p) {
    const PolygonPolynomial product = f[p] * g[p];
    Exact part = 0;
    for (const Exact& c : product.coefficients) part += c;
    sum += part / static_cast<int>(product.coefficients.size());
  }
  return sum;
}

void check_all_gc1(const SurfaceComplex& complex, const GcBasis& basis) {
  std::size_t bad = 0;
  for (std::size_t k = 0; k < basis.functions.size(); ++k)
    bad += is_gc1(complex, function_of(basis, k)) ? 0 : 1;
  CHECK(bad == 0);
}

}  // namespace

TEST_CASE("the octahedron has 1, 1, 1 and then 4(n-1)(n-2) splines, dual to what lies inside", "[complex]") {
  const SurfaceComplex h = octahedron_complex();
  for (int n = 0; n <= 8; ++n) {
    CAPTURE(n);
    const SplineSpace space = spline_space(h, n);
    CHECK(space.dimension() == (n < 3 ? 1u : static_cast<std::size_t>(4 * (n - 1) * (n - 2))));
    CHECK(space.solutions.exact);
    std::set<std::size_t> supports;
    std::size_t on_boundary = 0;
    for (std::size_t k = 0; k < space.dimension(); ++k) {
      supports.insert(support_of(space, k).size());
      const int place = space.solutions.free[k] % coefficient_count(3, n);
      on_boundary += steps_from_boundary(3, n, place) == 0 ? 1 : 0;
    }
    if (n < 3) continue;
    CHECK(on_boundary == 0);
    // A twist moves all coefficients of first order around its corner; in degree 3 it is that of three
    // corners. Others move an edge or nothing outside.
    CHECK(supports == (n == 3   ? std::set<std::size_t>{7}
                       : n == 4 ? std::set<std::size_t>{4}
                       : n == 5 ? std::set<std::size_t>{2, 4}
                                : std::set<std::size_t>{1, 2, 4}));
    if (n <= 5) check_all_gc1(h, basis_of(h, space));
  }
}

TEST_CASE("h1 to h8 are those of Figure 2", "[complex]") {
  const GcBasis basis = octahedron_splines(3);
  REQUIRE(basis.functions.size() == 8);
  CHECK(basis.names[0] == "h1");
  const auto& h1 = basis.functions[0];
  CHECK(listed(h1[0]) == "3 3 3 5 5 5 5 5 5 12");
  CHECK(listed(h1[1]) == "3 3 0 5 5 1 0 0 1 0");
  CHECK(listed(h1[2]) == "3 0 3 1 0 0 1 5 5 0");
  CHECK(listed(h1[4]) == "0 3 3 0 1 5 5 1 0 0");
  CHECK(listed(h1[3]) == "3 0 0 1 0 0 0 0 1 0");
  CHECK(listed(h1[5]) == "0 3 0 0 1 1 0 0 0 0");
  CHECK(listed(h1[6]) == "0 0 3 0 0 0 1 1 0 0");
  CHECK(listed(h1[7]) == "0 0 0 0 0 0 0 0 0 0");
  CHECK(listed(basis.functions[5][2]) == "0 0 0 0 0 0 0 0 0 0");
}

TEST_CASE("the hierarchical basis is one, orthogonal but for HC and HD", "[complex]") {
  const SurfaceComplex h = octahedron_complex();
  const GcBasis basis = octahedron_hierarchy();
  REQUIRE(basis.functions.size() == 8);
  check_all_gc1(h, basis);
  for (const PolygonPolynomial& p : basis.functions[0]) CHECK(listed(p) == "1 1 1 1 1 1 1 1 1 1");
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(scalar_product(basis.functions[i], basis.functions[i]) > 0);
    for (std::size_t j = i + 1; j < 8; ++j) {
      CAPTURE(basis.names[i], basis.names[j]);
      CHECK((scalar_product(basis.functions[i], basis.functions[j]) == 0) == !(i == 6 && j == 7));
    }
  }
  // Independent: HC and HD span a plane.
  const auto &c = basis.functions[6], &d = basis.functions[7];
  const Exact cd = scalar_product(c, d);
  CHECK(cd * cd < scalar_product(c, c) * scalar_product(d, d));
}

TEST_CASE("over u^2 + v^2 + w^2 there are 9 functions of degree 2", "[complex]") {
  const SurfaceComplex h = octahedron_complex();
  const GcBasis basis = octahedron_rationals();
  const SplineSpace space = spline_space(h, 2, basis.denominators);
  CHECK(space.dimension() == 9);
  CHECK(basis.functions.size() == 9);
  check_all_gc1(h, basis);
  check_all_gc1(h, basis_of(h, space));
  // Independent: each of A to F is alone in being 1 at its vertex, the others vanish at all vertices and each
  // is alone in not vanishing in the middle of its edges.
  const auto value = [&](std::size_t k, int octant, double u, double v) {
    return value_at(function_of(basis, k), octant, u, v);
  };
  const int octant_at[6] = {0, 0, 0, 1, 2, 4};
  const double place[6][2] = {{1, 0}, {0, 1}, {0, 0}, {0, 0}, {0, 1}, {1, 0}};
  for (std::size_t k = 0; k < 9; ++k) {
    for (std::size_t m = 0; m < 6; ++m)
      CHECK(value(k, octant_at[m], place[m][0], place[m][1]) == (k == m ? 1.0 : 0.0));
    if (k < 6) continue;
    CHECK(value(k, 0, 0.0, 0.5) == (k == 6 ? 0.5 : 0.0));
    CHECK(value(k, 0, 0.5, 0.0) == (k == 7 ? 0.5 : 0.0));
    CHECK(value(k, 0, 0.5, 0.5) == (k == 8 ? 0.5 : 0.0));
  }
  // Equation 2.8: the signs of G_uv.
  const double signs[8] = {1, 1, -1, -1, -1, -1, 1, 1};
  for (int octant = 0; octant < 8; ++octant) CHECK(value(8, octant, 0.5, 0.5) == 0.5 * signs[octant]);
}

TEST_CASE("products and quotients of geometrically continuous functions are such functions", "[complex]") {
  const SurfaceComplex h = octahedron_complex();
  const GcBasis cubic = octahedron_splines(3), rational = octahedron_rationals();
  const GcFunction one = constant_function(h, 1), ga = function_of(rational, 0),
                   guv = function_of(rational, 8);
  const GcFunction paper = quotient(ga, add(one, guv, 1));
  CHECK(is_gc1(h, paper));
  CHECK(paper.numerators[0].degree == 2);
  CHECK(value_at(paper, 0, 0.5, 0.25) == Approx((0.25 / 0.375) / (1 + 0.125 / 0.375)));
  const GcFunction h1 = function_of(cubic, 0), h4 = function_of(cubic, 3);
  const GcFunction product = h1 * h4;
  CHECK(is_gc1(h, product));
  CHECK(product.numerators[0].degree == 6);
  CHECK(value_at(product, 0, 0.3, 0.5) == Approx(value_at(h1, 0, 0.3, 0.5) * value_at(h4, 0, 0.3, 0.5)));
  CHECK(is_gc1(h, add(product, ga, Exact(3) / 7)));
  CHECK(is_gc1(h, quotient(h1, add(one, h4 * h4, 1))));
  // g_A of equation 2.5 is continuous and no more: on the edge PQ its derivatives towards R are -u on both
  // sides, which should add up to 0; at P they are 1 and 1.
  GcFunction flat = one;
  for (std::size_t p = 0; p < 8; ++p)
    flat.numerators[p] = {3, 1, p < 4 ? std::vector<Exact>{0, 0, 1} : std::vector<Exact>(3)};
  CHECK_FALSE(is_gc1(h, flat));
  const GcDefect defect = gc1_defect(h, flat);
  CHECK(defect.value == 0.0);
  CHECK(defect.derivative == 2.0);
}

TEST_CASE("the cube and the tori have splines from degree 2 on", "[complex]") {
  // 6 (n - 1)^2: what lies inside the faces is free.
  const SurfaceComplex cube = cube_complex();
  for (int n = 1; n <= 5; ++n) {
    const SplineSpace space = spline_space(cube, n);
    CHECK(space.dimension() == (n < 2 ? 1u : static_cast<std::size_t>(6 * (n - 1) * (n - 1))));
    if (n <= 3) check_all_gc1(cube, basis_of(cube, space));
  }
  const SurfaceComplex torus = torus_complex(2, 2);
  const std::size_t expected[3] = {1, 4, 36};
  for (int n = 1; n <= 3; ++n) {
    const SplineSpace space = spline_space(torus, n);
    CHECK(space.dimension() == expected[n - 1]);
    check_all_gc1(torus, basis_of(torus, space));
  }
}

TEST_CASE("parameters and denominators may be rational", "[complex]") {
  // s meets mu = s / (2 - s); on the first square functions are over (2 - u)^n, so that all n + 1 functions
  // of the second one's edge are met.
  const EdgeFunction mu(linear(0, 1), linear(2, -1));
  for (int n = 1; n <= 3; ++n) {
    SurfaceComplex complex;
    complex.sides = {4, 4};
    complex.joins = {join_by_image({0, 0}, {1, 0}, mu, {EdgeFunction(linear(1, 1)), EdgeFunction(-1)})};
    PolygonPolynomial factor{4, 1, {Exact(2), Exact(2), Exact(1), Exact(1)}};
    PolygonPolynomial denominator = constant_polynomial(4, 1);
    for (int k = 0; k < n; ++k) denominator = denominator * factor;
    const SplineSpace space = spline_space(complex, n, {denominator, constant_polynomial(4, 1)});
    check_all_gc1(complex, basis_of(complex, space));
    // Of 2 (n + 1)^2 coefficients the first square's on the edge follow, and so do those next to it as far as
    // 1 / (2 - u)^n lets the derivatives agree: those are 2 (n - 1) more than the common degree holds.
    CHECK(space.dimension() >= static_cast<std::size_t>(2 * (n + 1) * (n + 1) - 2 * (n + 1) - 2));
    SurfaceComplex same = complex;
    same.exact = false;
    CHECK(spline_space(same, n, {denominator, constant_polynomial(4, 1)}).dimension() == space.dimension());
    CAPTURE(n, space.dimension());
  }
}

TEST_CASE("singular values find the exact dimensions, with a wide gap", "[complex]") {
  for (const SurfaceComplex& exact : {octahedron_complex(), cube_complex(), torus_complex(2, 2)}) {
    SurfaceComplex same = exact;
    same.exact = false;
    for (int n = 1; n <= 4; ++n) {
      const SplineSpace a = spline_space(exact, n), b = spline_space(same, n);
      CAPTURE(n, exact.sides.size(), b.solutions.gap);
      CHECK(a.dimension() == b.dimension());
      CHECK(b.solutions.gap > 1e10);
      CHECK(a.solutions.free == b.solutions.free);
    }
  }
}

TEST_CASE("five triangles at a vertex: irrational data, whose functions are continuous to rounding",
          "[complex]") {
  std::vector<Gluing> gluings;
  for (int k = 0; k < 5; ++k) {
    const int next = (k + 1) % 5;
    gluings.push_back({{k, 0}, {5 + k, 0}, false});
    gluings.push_back({{k, 1}, {next, 2}, true});
    gluings.push_back({{5 + k, 1}, {5 + next, 2}, true});
  }
  const SurfaceComplex complex = regular_complex(std::vector<int>(10, 3), gluings);
  REQUIRE_FALSE(complex.exact);
  for (int n = 3; n <= 5; ++n) {
    const SplineSpace space = spline_space(complex, n);
    const GcBasis basis = basis_of(complex, space);
    CAPTURE(n, space.solutions.gap, space.dimension());
    CHECK(space.solutions.gap > 1e10);
    // Less than what lies inside by two for each apex: a rank found by singular values and by elimination.
    CHECK(space.dimension() == 10u * static_cast<std::size_t>((n - 1) * (n - 2) / 2) - 4u);
    double worst = 0.0;
    for (std::size_t k = 0; k < basis.functions.size(); ++k) {
      const GcDefect d = gc1_defect(complex, function_of(basis, k));
      worst = std::max({worst, d.value, d.derivative});
    }
    // Coefficients of size 10 at most, derivatives n times that, and elimination's growth: 1e4 eps.
    CHECK(worst < 2e-12);
  }
}

TEST_CASE("a rank that is not clear is an error", "[complex]") {
  // Singular values of about 2, 1e-5 and 1e-7.
  const std::vector<SparseRow> rows = {{{0, Exact(1)}, {1, Exact(1)}},
                                       {{0, Exact(1)}, {1, Exact(1) + Exact(2e-5)}},
                                       {{0, Exact(1)}, {1, Exact(1)}, {2, Exact(2e-7)}}};
  CHECK_THROWS_AS(rounded_null_space(rows, {0, 1, 2}), std::runtime_error);
  CHECK(exact_null_space(rows, {0, 1, 2}).rank == 3);
  CHECK(exact_null_space(rows, {0, 1, 2}).basis.empty());
}

}  // namespace rondure
