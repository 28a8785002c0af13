// Three routes to the net of a composition (Cobb 1988, section 8): interpolation at nodes, products of
// Bernstein polynomials, and symbolic algebra, which means the power basis. All three in double here, against
// the exact tables and against 50 digits: the library multiplies Bernstein polynomials because that loses the
// least.
#include "tests/bezier/composition_routes.h"

#include <fmt/format.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tests/bezier/cube_face.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"

namespace rondure {
namespace {

using namespace routes;

using Big = boost::multiprecision::cpp_bin_float_50;

// The largest error of a coefficient in eps of the largest coefficient of its coordinate.
double error(const Coordinates<double>& computed, const Coordinates<Big>& exact) {
  double worst = 0.0;
  for (std::size_t c = 0; c < 4; ++c) {
    REQUIRE(computed[c].coefficients.size() == exact[c].coefficients.size());
    double size = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < exact[c].coefficients.size(); ++k) {
      const Big& e = exact[c].coefficients[k];
      size = std::max(size, std::abs(static_cast<double>(e)));
      largest = std::max(largest, std::abs(static_cast<double>(Big(computed[c].coefficients[k]) - e)));
    }
    worst = std::max(worst, largest / size);
  }
  return worst * 0x1p52;
}

// In eps: what either route makes of some 4 d rounding errors in each of its values. Interpolation multiplies
// them by the largest row sum of the inverse collocation matrix, once a direction.
double interpolation_bound(int d) {
  std::vector<std::vector<Big>> rows, inverse;
  for (int i = 0; i <= d; ++i) {
    rows.push_back(bernstein(d, Big(Big(i) / d)));
    inverse.emplace_back(static_cast<std::size_t>(d) + 1, Big(0));
    inverse[static_cast<std::size_t>(i)][static_cast<std::size_t>(i)] = 1;
  }
  solve(rows, inverse);
  double norm = 0.0;
  for (const auto& row : inverse) {
    Big sum = 0;
    for (const Big& x : row) sum += abs(x);
    norm = std::max(norm, static_cast<double>(sum));
  }
  return 4.0 * d * norm * norm;
}

// The power basis by the sum of C(d, i) 2^i, once a direction.
double powers_bound(int d) { return 4.0 * d * std::pow(3.0, 2 * d); }

PlanarMap<Poly<Big>> in_big(const PlanarMap<Poly<double>>& g) {
  return {converted<Big>(g.x), converted<Big>(g.y), converted<Big>(g.w)};
}

// Inverse stereographic projection as a patch over [-2, 2]^2 in the plane, moved to [0, 1]^2.
TensorNet stereographic_square() {
  TensorNet net(2, 2);
  const double c[3] = {-2, 0, 2}, s[3] = {4, -4, 4};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) net.at(i, j) = {4 * c[i], 4 * c[j], s[i] + s[j] - 4, s[i] + s[j] + 4};
  }
  return net;
}

// The disk of Table 1 in the parameters of that square.
PlanarMap<Poly<double>> unit_disk() {
  const double h = std::sqrt(0.5);
  const double x[9] = {2, 2 * h, 0, 2 * h, 0, -2 * h, 0, -2 * h, -2},
               y[9] = {0, 2 * h, 2, -2 * h, 0, 2 * h, -2, -2 * h, 0};
  const double w[9] = {1, h, 1, h, 1, h, 1, h, 1};
  PlanarMap<Poly<double>> g{Poly<double>(2, 2), Poly<double>(2, 2), Poly<double>(2, 2)};
  for (std::size_t k = 0; k < 9; ++k) {
    g.x.coefficients[k] = x[k] / 4 + w[k] / 2;
    g.y.coefficients[k] = y[k] / 4 + w[k] / 2;
    g.w.coefficients[k] = w[k];
  }
  return g;
}

PlanarMap<Poly<double>> curved_quad() {
  PlanarMap<Poly<double>> g{Poly<double>(2, 2), Poly<double>(2, 2), Poly<double>(2, 2)};
  NetMaker make(81);
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; j <= 2; ++j) {
      const double w = make.uniform(0.7, 1.4);
      g.x.at(i, j) = w * (0.2 + 0.3 * i + make.uniform(-0.1, 0.1));
      g.y.at(i, j) = w * (0.2 + 0.3 * j + make.uniform(-0.1, 0.1));
      g.w.at(i, j) = w;
    }
  }
  return g;
}

}  // namespace

TEST_CASE("three routes lead to one net, and products of Bernstein polynomials lose the least",
          "[bezier][routes]") {
  const struct {
    const char* name;
    TensorNet f;
    PlanarMap<Poly<double>> g;
    int degree;
  } cases[] = {{"disk in the stereographic square", stereographic_square(), unit_disk(), 8},
               {"curved quadrilateral in a cube's face", cube_face(), curved_quad(), 16}};
  for (const auto& c : cases) {
    const Coordinates<Big> exact = by_interpolation(c.f, in_big(c.g));
    REQUIRE(exact[0].m == c.degree);
    const double products = error(by_products(c.f, c.g), exact);
    const double interpolation = error(by_interpolation(c.f, c.g), exact);
    const double powers = error(by_powers(c.f, c.g), exact);
    INFO(fmt::format("{}, errors in eps: products {:.3g}, interpolation {:.3g}, powers {:.3g}", c.name,
                     products, interpolation, powers));
    // The 50 digits agree whichever route they take: another has lost at most the conversion's 10^10.
    CHECK(error(by_products(c.f, c.g), by_powers(c.f, in_big(c.g))) == products);
    // Convex combinations of products of two factors, the degree times.
    CHECK(products < 2.0 * c.degree);
    CHECK(interpolation < interpolation_bound(c.degree));
    CHECK(powers < powers_bound(c.degree));
    CHECK(products < 0.5 * interpolation);
    CHECK(products < 0.5 * powers);
  }
}

TEST_CASE("the routes agree with the printed tables", "[bezier][routes]") {
  // Table 2 from the disk of Table 1: composed with s as a patch of its own, it comes with the factor W^2.
  const Coordinates<double> products = by_products(stereographic_square(), unit_disk());
  const nlohmann::json net = reference_entry(reference_data("cobb_nets.json"), "hemisphere")["net"];
  Coordinates<double> table;
  for (std::size_t c = 0; c < 4; ++c) {
    table[c] = Poly<double>(4, 4);
    for (int i = 0; i <= 4; ++i) {
      for (int j = 0; j <= 4; ++j) table[c].at(i, j) = number(net[i][j][c]);
    }
  }
  const Poly<double> ww = multiply(unit_disk().w, unit_disk().w);
  Coordinates<Big> expected;
  double scale = 0.0;
  for (std::size_t c = 0; c < 4; ++c) expected[c] = converted<Big>(multiply(ww, table[c]));
  scale = products[3].at(0, 0) / static_cast<double>(expected[3].at(0, 0));
  for (Poly<Big>& p : expected) {
    for (Big& c : p.coefficients) c *= scale;
  }
  // Both sides are rounded, some products deep.
  CHECK(error(products, expected) < 32.0);
  CHECK(error(by_interpolation(stereographic_square(), unit_disk()), expected) < interpolation_bound(8));
  CHECK(error(by_powers(stereographic_square(), unit_disk()), expected) < powers_bound(8));
}

}  // namespace rondure
