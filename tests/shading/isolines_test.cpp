#include "renderer/shading/isolines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "renderer/bezier/rational.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

namespace {

// A grid of parameters that avoids the lines themselves.
constexpr int line_grid = 61;
double grid_parameter(int i) { return (i + 0.5) / line_grid; }

// The angle of a quarter circle's rational quadratic with weights 1, sqrt(1/2), 1 at parameter t.
double quarter_angle(double t) {
  const double s = 1.0 - t, middle = std::sqrt(2.0) * s * t;
  return std::atan2(middle + t * t, s * s + middle);
}

}  // namespace

// On the octant that touches the pole the lines are meridians and parallels, whose distances have closed
// forms. Within 1e-9 of the line's edge either answer is right: four Gauss-Newton steps leave less than that
// on arcs of at most a quarter turn.
TEST_CASE("isolines of the octant are bands about meridians and parallels", "[shading]") {
  const Surface octant = build_family(R"({ "type": "sphere_octant", "octants": [0] })");
  REQUIRE(octant.patches.size() == 1);
  const Net& net = octant.patches[0];
  const Isolines lines{4, 0.05, 0.1, dvec3(0.0)};
  const dvec3 pole = net_point(net, 0.5, 1.0), start = net_point(net, 0.0, 0.0),
              end = net_point(net, 1.0, 0.0);
  int wrong = 0, drawn = 0, left_out = 0;
  for (int i = 0; i < line_grid; ++i) {
    for (int j = 0; j < line_grid; ++j) {
      const double u = grid_parameter(i), v = grid_parameter(j);
      const dvec3 p = net_point(net, u, v);
      double excess = INFINITY;  // of the distance to a line over half of its width
      for (int k = 0; k <= lines.count; ++k) {
        const double angle = quarter_angle(static_cast<double>(k) / lines.count);
        const double half = 0.5 * (k % lines.count == 0 ? lines.boundary_width : lines.width);
        const dvec3 across = std::cos(angle) * end - std::sin(angle) * start;
        const double to_meridian = 2.0 * std::sin(0.5 * std::asin(std::fabs(glm::dot(p, across))));
        const double height = std::asin(std::clamp(glm::dot(p, pole), -1.0, 1.0));
        const double to_parallel = 2.0 * std::sin(0.5 * std::fabs(height - angle));
        excess = std::min({excess, to_meridian - half, to_parallel - half});
      }
      if (std::fabs(excess) < 1e-9) {
        ++left_out;
        continue;
      }
      const bool line = on_isoline(lines, net, p, u, v);
      drawn += line;
      wrong += line != (excess < 0.0);
    }
  }
  INFO(drawn << " of " << line_grid * line_grid << " points on a line, " << left_out
             << " too near to its edge");
  CHECK(wrong == 0);
  CHECK(drawn > line_grid * line_grid / 10);
  CHECK(drawn < line_grid * line_grid / 2);
  CHECK(left_out < 5);
}

// At a hemisphere's corner d/du and d/dv are parallel. The independent answer is the nearest of 20,001 points
// of each line; the lines are shorter than 4, so that one of these lies within 1e-4 of the nearest.
TEST_CASE("isolines keep their width at a singular corner", "[shading]") {
  const Surface cap = build_family(R"({ "type": "sphere_cap" })");
  const Net& net = cap.patches.at(0);
  const Isolines lines{8, 0.004, 0.008, dvec3(0.0)};
  constexpr int samples = 20000;
  std::vector<dvec3> points[2];
  for (int family = 0; family < 2; ++family) {
    for (int k = 0; k <= 2; ++k) {
      for (int s = 0; s <= samples; ++s) {
        const double at = static_cast<double>(k) / lines.count, along = static_cast<double>(s) / samples;
        points[family].push_back(family == 0 ? net_point(net, at, along) : net_point(net, along, at));
      }
    }
  }
  int wrong = 0, drawn = 0;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      const double u = 0.1 * (i + 0.5) / 20, v = 0.1 * (j + 0.5) / 20;
      const dvec3 p = net_point(net, u, v);
      double excess = INFINITY;
      for (const auto& line : points) {
        for (std::size_t k = 0; k < line.size(); ++k) {
          const double half = 0.5 * (k <= samples ? lines.boundary_width : lines.width);
          excess = std::min(excess, glm::distance(p, line[k]) - half);
        }
      }
      const bool line = on_isoline(lines, net, p, u, v);
      drawn += line;
      if (std::fabs(excess) > 1e-4) wrong += line != (excess < 0.0);
    }
  }
  INFO(drawn << " of 400 points on a line");
  CHECK(wrong == 0);
  CHECK(drawn > 20);
  CHECK(drawn < 380);
}
