// Elevation, subdivision, arcs: the surface stays where it is.
#include "renderer/inverse_spherical/modelling.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "renderer/bezier/epsilon.h"
#include "renderer/inverse_spherical/evaluate.h"
#include "renderer/inverse_spherical/octant_model.h"
#include "tests/catch.h"
#include "tests/inverse_spherical/random_iss.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

dvec3 direction_in(const PlanarIss& s, dvec2 at) {
  return at.x * s.corners[0] + at.y * s.corners[1] + (1.0 - at.x - at.y) * s.corners[2];
}

// The part's points lie on `whole`: same radius in the same direction. Both are good to some epsilon of
// degree, moduli and weights (see evaluate_test).
void compare(const PlanarIss& part, const PlanarIss& whole, NetMaker& make, WorstCase& worst) {
  for (int k = 0; k < 6; ++k) {
    const dvec3 p = point_by_weights(part, make.in_triangle().x, 0.0);
    const dvec2 at = make.in_triangle();
    const dvec3 q = k == 0 ? p : point_by_weights(part, at.x, at.y);
    const std::optional<double> r = radius_towards(whole, q);
    const double off = r ? std::abs(*r / glm::length(q) - 1.0) : 1.0;
    worst.add(off, 12.5 * 24.0 * 8.0 * (whole.n + 1) * epsilon,
              [&] { return fmt::format("degree {}, point {}", whole.n, k); });
  }
}

}  // namespace

TEST_CASE("elevation keeps the surface", "[iss]") {
  NetMaker make(41);
  WorstCase worst, general;
  for (int n = 1; n <= 6; ++n) {
    const PlanarIss s = random_planar_iss(make, n);
    for (int times = 0; times <= 5; ++times) {
      const PlanarIss high = elevated(s, times);
      REQUIRE(high.n == n + times);
      REQUIRE(high.corners == s.corners);
      compare(high, s, make, worst);
    }
    const TriangleNet net = net_of(random_general_iss(make, n));
    const TriangleNet higher = elevated(net, 3);
    for (int k = 0; k < 6; ++k) {
      const dvec2 at = make.in_triangle();
      const dvec3 p = point_by_casteljau(net, at.x, at.y);
      general.add(glm::distance(p, point_by_casteljau(higher, at.x, at.y)) / glm::length(p),
                  500.0 * (n + 3) * epsilon, [&] { return fmt::format("degree {}", n); });
    }
  }
  INFO(worst.text());
  INFO(general.text());
  CHECK(worst.failures() + general.failures() == 0);
}

TEST_CASE("subdivision keeps the surface, and its parts fill the triangle", "[iss]") {
  NetMaker make(42);
  WorstCase worst, corner;
  for (int trial = 0; trial < 30; ++trial) {
    const int n = 1 + trial % 7;
    const PlanarIss s = random_planar_iss(make, n);
    const dvec2 at = make.in_triangle();
    double area = 0.0;
    const double whole = orientation(s.corners[0], s.corners[1], s.corners[2]);
    int place = 0;
    for (const PlanarIss& part : split_at(s, at.x, at.y)) {
      compare(part, s, make, worst);
      area += orientation(part.corners[0], part.corners[1], part.corners[2]) / whole;
      const dvec3 meeting = part.corners[static_cast<std::size_t>(place++)];
      corner.add(glm::distance(meeting, direction_in(s, at)), 0.0 + epsilon,
                 [&] { return std::string("meeting point"); });
    }
    corner.add(std::abs(area - 1.0), 100.0 * epsilon,
               [&] { return fmt::format("three parts, trial {}", trial); });
    area = 0.0;
    for (const PlanarIss& part : quartered(s)) {
      compare(part, s, make, worst);
      const double share = orientation(part.corners[0], part.corners[1], part.corners[2]) / whole;
      corner.add(std::abs(share - 0.25), 100.0 * epsilon,
                 [&] { return fmt::format("four parts, trial {}", trial); });
      area += share;
    }
  }
  INFO(worst.text());
  INFO(corner.text());
  CHECK(worst.failures() == 0);
  CHECK(corner.failures() == 0);
}

TEST_CASE("along a great-circle arc the surface is an inverse circular curve", "[iss]") {
  NetMaker make(43);
  WorstCase points, plane, control;
  for (int trial = 0; trial < 60; ++trial) {
    const PlanarIss s = random_planar_iss(make, 1 + trial % 7);
    const dvec2 from = make.in_triangle(), to = trial % 5 == 0 ? dvec2(0.0, 1.0) : make.in_triangle();
    const InverseCircularCurve curve = along_arc(s, from, to);
    const dvec3 normal = glm::normalize(glm::cross(curve.from, curve.to));
    const std::vector<double> c = curve.coefficients();
    for (int k = 0; k <= 8; ++k) {
      const dvec3 p = curve.point(k / 8.0);
      const auto say = [&] { return fmt::format("trial {} at {}/8", trial, k); };
      const std::optional<double> r = radius_towards(s, p);
      points.add(r ? std::abs(*r / glm::length(p) - 1.0) : 1.0, 12.5 * 24.0 * 8.0 * (s.n + 1) * epsilon, say);
      const double bent =
          glm::length(glm::cross(curve.from, curve.to)) / (glm::length(curve.from) * glm::length(curve.to));
      plane.add(std::abs(glm::dot(p, normal)) / glm::length(p), 8.0 * epsilon / bent, say);
    }
    // Ends: the surface's own points, at distance 1 / c.
    control.add(std::abs(glm::length(curve.point(0.0)) * c.front() - 1.0), 8.0 * epsilon,
                [] { return std::string("start"); });
    control.add(std::abs(glm::length(curve.point(1.0)) * c.back() - 1.0), 8.0 * epsilon,
                [] { return std::string("end"); });
  }
  INFO(points.text());
  INFO(plane.text());
  CHECK(points.failures() + plane.failures() + control.failures() == 0);
}

TEST_CASE("an arc between two directions is cut to each patch that it crosses", "[iss]") {
  // A closed model: the pieces of an arc fill it, end to end, on the surface.
  std::array<std::vector<double>, 8> interior;
  interior.fill(std::vector<double>(15, 0.8));
  interior[3].assign(15, 0.3);
  const std::array<PlanarIss, 8> model = octant_model(4, interior);
  NetMaker make(44);
  WorstCase filled, points, joints;
  for (int trial = 0; trial < 100; ++trial) {
    dvec3 ends[2];
    for (dvec3& d : ends) d = dvec3(make.uniform(-1, 1), make.uniform(-1, 1), make.uniform(-1, 1));
    if (trial % 10 == 0) ends[0].z = ends[1].z = 0.0;  // along sides, which two patches share
    if (trial % 10 == 1) ends[0] = {0, 0, 1};          // from a corner
    const auto say = [&] { return fmt::format("trial {}", trial); };
    double angle = 0.0;
    std::vector<dvec3> tips;
    for (const PlanarIss& s : model) {
      const std::optional<InverseCircularCurve> curve = along_arc(s, ends[0], ends[1]);
      if (!curve) continue;
      CHECK(curve->n == 4);
      const auto bend = [](const dvec3& a, const dvec3& b) {
        return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
      };
      angle += bend(curve->from, curve->to);
      for (int k = 0; k <= 4; ++k) {
        const dvec3 p = curve->point(k / 4.0);
        const std::optional<double> r = radius_towards(s, p);
        points.add(r ? std::abs(*r / glm::length(p) - 1.0) : 1.0, 12.5 * 24.0 * 5.0 * epsilon, say);
        // On the arc: in its plane, and between its ends.
        const double beyond = bend(ends[0], p) + bend(p, ends[1]) - bend(ends[0], ends[1]);
        points.add(std::abs(beyond), 1e-7, say);
      }
      for (const double t : {0.0, 1.0}) tips.push_back(curve->point(t));
    }
    const double whole = std::atan2(glm::length(glm::cross(ends[0], ends[1])), glm::dot(ends[0], ends[1]));
    filled.add(std::abs(angle / whole - (trial % 10 == 0 ? 2.0 : 1.0)), 1e-13 / std::min(whole, 1.0), say);
    // All tips but the arc's own two lie on each other in pairs; along sides everything comes twice.
    int alone = 0;
    for (std::size_t a = 0; a < tips.size(); ++a) {
      int near = 0;
      for (std::size_t b = 0; b < tips.size(); ++b) near += a != b && glm::distance(tips[a], tips[b]) < 1e-12;
      alone += near == 0;
    }
    joints.add(std::abs(alone - (trial % 10 == 0 ? 0 : 2)), 0.5, say);
  }
  INFO("filled: " << filled.text());
  INFO("points: " << points.text());
  INFO("joints: " << joints.text());
  CHECK(filled.failures() + points.failures() + joints.failures() == 0);

  const PlanarIss& s = model[0];
  CHECK_FALSE(along_arc(s, dvec3(-1, -1, 0.5), dvec3(-1, 0, 1)).has_value());
  CHECK_FALSE(along_arc(s, dvec3(0, 0, 1), dvec3(-1, -1, 1)).has_value());      // touches a corner
  CHECK_FALSE(along_arc(s, dvec3(-1, -1, -1), dvec3(-1, -2, -1)).has_value());  // on the other side
  // The curve's control points are those of a rational curve: the same point from both.
  const InverseCircularCurve curve = *along_arc(s, dvec3(1, 2, 0.5), dvec3(0.3, 0.1, 4));
  dvec4 sum(0.0);
  const std::vector<dvec4> control = curve.control_points();
  for (std::size_t k = 0; k < 5; ++k) sum += std::array<double, 5>{1, 4, 6, 4, 1}[k] / 16.0 * control[k];
  CHECK(glm::distance(dvec3(sum) / sum.w, curve.point(0.5)) < 4.0 * epsilon);
}

TEST_CASE("a part of a surface on a domain that is not planar is none (Remark 7.1)", "[iss]") {
  // The paper's numbers: the common side's vectors lie in no plane through the origin.
  const dvec3 u002(0, 0, 1), u011(0, 0.5, 1), u101(1, 0, 1), u110(1, 1, 0), u200(1, 0, 0), u020(0, 1, 0);
  const dvec3 u001 = 0.5 * (u101 + u011), u000 = 0.25 * u200 + 0.5 * u110 + 0.25 * u020;
  CHECK(u001 == dvec3(0.5, 0.25, 1.0));
  CHECK(u000 == dvec3(0.75, 0.75, 0.0));
  CHECK(orientation(u002, u001, u000) == 3.0 / 16.0);  // not 0: no great circle
}

}  // namespace rondure
