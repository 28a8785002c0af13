// Joins, fans and closed models have one tangent plane along every common side and at every vertex.
#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <stdexcept>

#include "renderer/bezier/elevate.h"
#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/rational.h"
#include "renderer/inverse_spherical/evaluate.h"
#include "renderer/inverse_spherical/join.h"
#include "renderer/inverse_spherical/modelling.h"
#include "renderer/inverse_spherical/octant_model.h"
#include "renderer/inverse_spherical/vertex_fan.h"
#include "tests/catch.h"
#include "tests/inverse_spherical/random_iss.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// The normal, away from the origin, in direction v.
dvec3 normal_towards(const PlanarIss& s, const dvec3& v) {
  const dvec3 tau = domain_coordinates(s.corners, v);
  const TriangleNet net = net_of(s);
  const dvec3 n = unit_normal(net, tau.x, tau.y);
  return glm::dot(n, v) < 0.0 ? -n : n;
}

// Along the arc between two directions, ends included, both surfaces have one point and one tangent plane,
// and lie on either side: 1e-12 as the paper's claim is to be verified.
void check_side(const PlanarIss& a, const PlanarIss& b, const dvec3& from, const dvec3& to, WorstCase& worst,
                const std::string& what) {
  for (int k = 0; k <= 8; ++k) {
    const dvec3 v = (1.0 - k / 8.0) * from + k / 8.0 * to;
    const std::optional<double> ra = radius_towards(a, v), rb = radius_towards(b, v);
    const double apart = ra && rb ? std::abs(*ra / *rb - 1.0) : 1.0;
    worst.add(apart, 1e-13, [&] { return fmt::format("{}: radii at {}/8", what, k); });
    worst.add(glm::distance(normal_towards(a, v), normal_towards(b, v)), 1e-12,
              [&] { return fmt::format("{}: normals at {}/8", what, k); });
  }
}

std::vector<double> random_weights(NetMaker& make, int n, double low, double high) {
  std::vector<double> w(static_cast<std::size_t>(triangle_size(n)));
  for (double& x : w) x = make.uniform(low, high);
  return w;
}

}  // namespace

TEST_CASE("Proposition 2 joins with one tangent plane", "[iss]") {
  NetMaker make(51);
  WorstCase worst, flat;
  int joins = 0, refused = 0;
  for (int trial = 0; trial < 80; ++trial) {
    const int n = 1 + trial % 6;
    const PlanarIss s = rotated(random_planar_iss(make, n), trial % 3);
    const dvec3 direction = -make.uniform(0.2, 0.6) * s.corners[0] + make.uniform(0.5, 1.0) * s.corners[1] +
                            make.uniform(0.5, 1.0) * s.corners[2];
    const std::optional<dvec3> vertex = coplanar_vertex(s, direction);
    REQUIRE(vertex.has_value());
    const dvec3 k = domain_combination(s, *vertex);
    flat.add(std::abs(k.x + k.y + k.z - 1.0), 64.0 * epsilon, [&] { return fmt::format("trial {}", trial); });
    try {
      const PlanarIss t = joined(s, *vertex, random_weights(make, n, 0.5, 1.5));
      check_side(s, t, s.corners[1], s.corners[2], worst, fmt::format("trial {} degree {}", trial, n));
      ++joins;
    } catch (const std::invalid_argument&) {
      ++refused;  // a weight came out negative
    }
  }
  INFO(worst.text());
  INFO(joins << " joins, " << refused << " refused");
  CHECK(joins > 50);
  CHECK(worst.failures() == 0);
  CHECK(flat.failures() == 0);
}

TEST_CASE("domains that are not coplanar join where the side is of lower degree", "[iss]") {
  NetMaker make(52);
  WorstCase worst;
  int joins = 0;
  for (int trial = 0; trial < 80; ++trial) {
    const int n = 2 + trial % 5;
    PlanarIss s = random_planar_iss(make, n);
    // A side of degree n - 1, elevated.
    const std::vector<double> low = random_weights(make, n - 1, 0.7, 1.3);
    const PlanarIss side = elevated(PlanarIss{n - 1, s.corners, low}, 1);
    for (double& w : s.weights) w = make.uniform(0.8, 1.2);
    for (int j = 0; j <= n; ++j) {
      const auto at = static_cast<std::size_t>(triangle_index(n, 0, j));
      s.weights[at] = side.weights[at];
    }
    const dvec3 vertex = make.uniform(0.8, 1.25) *
                         (-make.uniform(0.2, 0.5) * s.corners[0] + make.uniform(0.5, 0.8) * s.corners[1] +
                          make.uniform(0.5, 0.8) * s.corners[2]);
    REQUIRE(reduced_side(s).has_value());
    try {
      const PlanarIss t = joined(s, vertex, random_weights(make, n, 0.5, 1.5));
      check_side(s, t, s.corners[1], s.corners[2], worst, fmt::format("trial {} degree {}", trial, n));
      ++joins;
    } catch (const std::invalid_argument&) {
    }
  }
  INFO(worst.text());
  CHECK(joins > 40);
  CHECK(worst.failures() == 0);
}

TEST_CASE("joins that cannot be are refused", "[iss]") {
  NetMaker make(53);
  const PlanarIss s{2, {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)}, {1, 1.3, 1, 0.9, 1, 1}};
  const std::vector<double> w(6, 1.0);
  CHECK_THROWS_WITH(joined(s, dvec3(0.2, 1, 1), w), Catch::Contains("alpha = 0.2 is not negative"));
  CHECK_THROWS_WITH(joined(s, dvec3(-1, 1, 1.5), w), Catch::Contains("the common side is not of degree 1"));
  CHECK_FALSE(reduced_side(s).has_value());
  CHECK_FALSE(coplanar_vertex(s, dvec3(-1, 0.2, 0.2)).has_value());
  const PlanarIss heavy{2, s.corners, {1, 1, 1, 9, 1, 1}};
  CHECK_THROWS_WITH(joined(heavy, dvec3(-1, 1, 1), w), Catch::Contains("not positive"));
}

TEST_CASE("three to eight patches meet smoothly around a vertex", "[iss]") {
  NetMaker make(54);
  WorstCase worst, still;
  int fans = 0;
  for (int sides = 3; sides <= 8; ++sides) {
    for (int n = 2; n <= 7; ++n) {
      FanDomain domain;
      domain.sides = sides;
      domain.centre = {0.1, -0.2, 1.1};
      domain.a = {0.8, 0.1, 0.1};
      domain.b = {-0.1, 0.7, 0.2};
      std::vector<std::vector<double>> weights;
      for (int m = 0; m < sides; ++m) weights.push_back(random_weights(make, n, 0.97, 1.03));
      const std::vector<PlanarIss> fan = smooth_fan(domain, n, weights);
      REQUIRE(fan.size() == static_cast<std::size_t>(sides));
      ++fans;
      std::vector<std::vector<double>> again;
      for (int m = 0; m < sides; ++m) {
        const PlanarIss &a = fan[static_cast<std::size_t>(m)],
                        &b = fan[static_cast<std::size_t>((m + 1) % sides)];
        check_side(a, b, a.corners[0], a.corners[2], worst,
                   fmt::format("{} patches of degree {}, {}", sides, n, m));
        again.push_back(a.weights);
      }
      // Smooth already: it stays, to the rounding of some sums over 1 / (2 cos), at most 1 / 0.6.
      const std::vector<PlanarIss> same = smooth_fan(domain, n, again);
      for (std::size_t m = 0; m < fan.size(); ++m) {
        for (std::size_t k = 0; k < fan[m].weights.size(); ++k) {
          still.add(std::abs(same[m].weights[k] - fan[m].weights[k]), 64.0 * epsilon,
                    [&] { return fmt::format("{} patches of degree {}", sides, n); });
        }
      }
    }
  }
  INFO(worst.text());
  INFO(still.text());
  CHECK(fans == 36);
  CHECK(worst.failures() == 0);
  CHECK(still.failures() == 0);
}

TEST_CASE("closed models of eight patches are smooth everywhere", "[iss]") {
  NetMaker make(55);
  WorstCase worst;
  for (int n = 3; n <= 8; ++n) {
    for (int trial = 0; trial < 4; ++trial) {
      std::array<std::vector<double>, 8> interior;
      for (auto& w : interior) w = random_weights(make, n, 0.2, 2.0);
      const std::array<PlanarIss, 8> model = octant_model(n, interior);
      for (std::size_t o = 0; o < 8; ++o) {
        int inside = 0;
        for (int i = 1; i < n; ++i) {
          for (int j = 1; j < n - i; ++j) {
            const auto at = static_cast<std::size_t>(triangle_index(n, i, j));
            inside += model[o].weights[at] == interior[o][at];
          }
        }
        CHECK(inside == (n - 1) * (n - 2) / 2);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const PlanarIss &a = model[o], &b = model[o ^ (std::size_t{1} << axis)];
          check_side(a, b, a.corners[(axis + 1) % 3], a.corners[(axis + 2) % 3], worst,
                     fmt::format("degree {} octant {} axis {}", n, o, axis));
        }
      }
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  // Exact weights of degree 3 with all inner weights 1: corners 3, sides 2.
  std::array<std::vector<double>, 8> ones;
  for (auto& w : ones) w.assign(10, 1.0);
  const std::vector<double> expected{3, 2, 2, 3, 2, 1, 2, 2, 2, 3};
  for (const PlanarIss& s : octant_model(3, ones)) CHECK(s.weights == expected);
}

}  // namespace rondure
