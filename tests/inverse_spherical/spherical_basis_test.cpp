// Spherical barycentric coordinates, the two forms of the spherical Bernstein basis, and what they add up to.
#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>

#include "renderer/bezier/epsilon.h"
#include "renderer/inverse_spherical/evaluate.h"
#include "tests/catch.h"
#include "tests/inverse_spherical/random_iss.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

double angle_to_plane(const dvec3& v, const dvec3& a, const dvec3& b) {
  return std::asin(glm::dot(v, glm::normalize(glm::cross(a, b))));
}

}  // namespace

TEST_CASE("spherical barycentric coordinates are ratios of sines", "[iss]") {
  NetMaker make(21);
  WorstCase sines, sum, above_one, side;
  for (int trial = 0; trial < 300; ++trial) {
    const std::array<dvec3, 3> t = random_triangle(make);
    const dvec2 at = make.in_triangle();
    const dvec3 v = glm::normalize(at.x * t[0] + at.y * t[1] + (1.0 - at.x - at.y) * t[2]);
    const dvec3 beta = spherical_barycentric(t, v);
    const auto say = [&] { return fmt::format("trial {}", trial); };
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const dvec3 &a = t[(k + 1) % 3], &b = t[(k + 2) % 3];
      // Equation 12 as it stands. Determinants of at least 0.2: epsilon / 0.2 each, and asin near its end
      // at 1.
      const double ratio = std::sin(angle_to_plane(v, a, b)) / std::sin(angle_to_plane(t[k], a, b));
      sines.add(std::abs(beta[i] - ratio), 100.0 * epsilon * (1.0 + std::abs(ratio)), say);
    }
    sum.add(glm::distance(beta.x * t[0] + beta.y * t[1] + beta.z * t[2], v), 100.0 * epsilon, say);
    // More than 1 inside.
    const double total = beta.x + beta.y + beta.z;
    above_one.add(total > 1.0 ? 0.0 : 1.0, 0.5, say);
    // On a side, ratios of sines of arcs.
    const double s = make.uniform(0.05, 0.95);
    const dvec3 e = glm::normalize((1.0 - s) * t[0] + s * t[1]);
    const dvec3 on_side = spherical_barycentric(t, e);
    const double whole = glm::length(glm::cross(t[0], t[1]));
    side.add(std::abs(on_side.x - glm::length(glm::cross(e, t[1])) / whole), 100.0 * epsilon, say);
    side.add(std::abs(on_side.z), 100.0 * epsilon, say);
  }
  INFO(sines.text());
  INFO(sum.text());
  INFO(side.text());
  CHECK(sines.failures() + sum.failures() + above_one.failures() + side.failures() == 0);
}

TEST_CASE("direction and domain coordinates are inverse to each other", "[iss]") {
  NetMaker make(22);
  WorstCase worst;
  for (int trial = 0; trial < 300; ++trial) {
    const PlanarIss s = random_planar_iss(make, 1);
    const dvec2 at = make.in_triangle();
    const dvec3 tau(at.x, at.y, 1.0 - at.x - at.y);
    const dvec3 u = tau.x * s.corners[0] + tau.y * s.corners[1] + tau.z * s.corners[2];
    // Moduli of 0.4 to 2.5 and a determinant of at least 0.2.
    worst.add(glm::distance(domain_coordinates(s.corners, make.uniform(0.1, 10.0) * u), tau),
              8.0 * 2.5 / 0.4 / 0.2 * epsilon, [&] { return fmt::format("trial {}", trial); });
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(domain_coordinates({dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)}, dvec3(1, -1, 0)) == dvec3(0.0));
}

TEST_CASE("Theorem 3 and Theorem 4 give one basis, with linear precision", "[iss]") {
  NetMaker make(23);
  WorstCase theorems, precision, radius;
  for (int n = 1; n <= 7; ++n) {
    for (int trial = 0; trial < 8; ++trial) {
      const Iss s = trial % 2 == 0 ? general_form(random_planar_iss(make, n)) : random_general_iss(make, n);
      const dvec2 at = make.in_triangle();
      const std::vector<double> paths = spherical_basis_by_paths(s, at.x, at.y);
      const std::vector<double> direct = spherical_basis(s, at.x, at.y);
      const auto say = [&] { return fmt::format("degree {} trial {}", n, trial); };
      dvec3 v(0.0);
      double p = 0.0, total = 0.0;
      for (std::size_t k = 0; k < paths.size(); ++k) {
        v += direct[k] * glm::normalize(s.u[k]);
        p += direct[k] * s.c[k];
        total += direct[k];
      }
      for (std::size_t k = 0; k < paths.size(); ++k) {
        // Products of n quotients and positive sums of them.
        theorems.add(std::abs(paths[k] - direct[k]), 16.0 * (n + 1) * epsilon * (direct[k] + total), say);
      }
      // Equation 14: sum v_ijk B_ijk = v. Equation 13: p = sum c_ijk B_ijk.
      const SphericalPoint point = point_by_spherical_casteljau(s, at.x, at.y);
      precision.add(glm::distance(v, point.direction), 16.0 * (n + 1) * epsilon * total, say);
      radius.add(std::abs(p / point.p - 1.0), 16.0 * (n + 1) * epsilon, say);
    }
  }
  INFO("theorems: " << theorems.text());
  INFO("linear precision: " << precision.text());
  INFO("reciprocal radius: " << radius.text());
  CHECK(theorems.failures() + precision.failures() + radius.failures() == 0);
}

TEST_CASE("an inverse spherical surface is a rational Bezier patch, and back", "[iss]") {
  NetMaker make(24);
  WorstCase worst;
  for (int n = 1; n <= 9; ++n) {
    const Iss s = random_general_iss(make, n);
    const TriangleNet net = net_of(s);
    const Iss back = iss_of(net);
    REQUIRE(back.n == n);
    CHECK(back.u == s.u);
    for (std::size_t k = 0; k < s.c.size(); ++k) {
      const auto say = [&] { return fmt::format("degree {} coefficient {}", n, k); };
      worst.add(std::abs(back.c[k] / s.c[k] - 1.0), 2.0 * epsilon, say);
      // Section 3: the control point is v / c, its distance 1 / c.
      worst.add(std::abs(glm::length(dvec3(net.points[k]) / net.points[k].w) * s.c[k] - 1.0), 4.0 * epsilon,
                say);
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  TriangleNet bad(1);
  bad.points = {dvec4(1, 0, 0, 1), dvec4(0, 1, 0, -1), dvec4(0, 0, 1, 1)};
  CHECK_THROWS_WITH(iss_of(bad), Catch::Contains("010 has a weight that is not positive"));
  bad.points[1] = dvec4(0, 0, 0, 1);
  CHECK_THROWS_AS(iss_of(bad), std::invalid_argument);
}

}  // namespace rondure
