// Where the grid of cells leaves a point to its candidates, and where rays come from too far for it.

#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/ellipsoid_fit.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/mapped.h"
#include "tests/intersect/random_direction.h"
#include "tests/surfaces/build_family.h"

namespace rondure {

// Some faces of one tiling and some of another, turned: a cell may be within one patch and hold the side of
// another, or lie where no sample of either falls.
TEST_CASE("Patches of one sphere that overlap are all met", "[solvers]") {
  std::mt19937_64 random(59);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const Surface tilings[] = {build_family(R"({"type": "sphere_tiling", "topology": "cube"})"),
                             build_family(R"({"type": "sphere_tiling", "topology": "octahedron_quads"})"),
                             build_family(R"({"type": "sphere_octant"})")};
  long inside = 0, lost = 0;
  std::string first = "none";
  for (int k = 0; k < 60; ++k) {
    Surface surface;
    for (int side = 0; side < 2; ++side) {
      const dmat4 turn = glm::rotate(dmat4(1.0), 6.3 * part(random), random_direction(random));
      for (const Net& net : mapped(tilings[(k + side) % 3], turn).patches)
        if (part(random) < 0.5) surface.patches.push_back(net);
    }
    if (surface.patches.empty()) continue;
    const Tracer newton({{surface, Solver::newton}}), quadric({{surface, Solver::quadric}});
    for (int j = 0; j < 2000; ++j) {
      const dvec3 from = 3.0 * random_direction(random);
      const Ray ray{from, 0.9 * random_direction(random) - from};
      const Hit a = newton.closest(ray), b = quadric.closest(ray);
      if (!a) continue;
      const bool triangle =
          std::holds_alternative<TriangleNet>(surface.patches[static_cast<std::size_t>(a.patch)]);
      const double far = triangle ? 1.0 - a.u - a.v : 1.0 - std::max(a.u, a.v);
      if (std::min({a.u, a.v, far}) < 1e-9) continue;  // at a rim either answer is right
      ++inside;
      if (b && std::fabs(b.t - a.t) <= a.t_error + b.t_error + 1e-12) continue;
      ++lost;
      if (first == "none") first = fmt::format("surface {}, ray {}", k, j);
    }
  }
  INFO(lost << " of " << inside << " hits; the first: " << first);
  CHECK(lost == 0);
  CHECK(inside > 60'000);
}

// Where a patch is singular and its weight is a hundredth of its greatest: what a search leaves is to be
// small at the size of the point.
// Weights times a^i b^j: the same patches, with the Moebius images of their parameters.
Surface reparametrised(Surface surface, double a, double b) {
  for (Net& net : surface.patches) {
    auto& tensor = std::get<TensorNet>(net);
    for (int i = 0; i <= tensor.m; ++i)
      for (int j = 0; j <= tensor.n; ++j) tensor.at(i, j) *= std::pow(a, i) * std::pow(b, j);
  }
  return surface;
}

TEST_CASE("Singular corners of small weight are met", "[solvers]") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<std::pair<std::string, Surface>> cases;
  for (const int weight : {1, 30, 100})
    cases.emplace_back(
        fmt::format("middle weight {}", weight),
        build_family(fmt::format(
            R"({{"type": "sphere_tiling", "topology": "octahedron_pairs", "middle_weight": {}}})", weight)));
  const Surface hemispheres = build_family(R"({"type": "sphere_tiling", "topology": "hemispheres"})");
  cases.emplace_back("hemispheres, 3^i 0.4^j", reparametrised(hemispheres, 3.0, 0.4));
  cases.emplace_back("hemispheres, 0.2^i 0.3^j", reparametrised(hemispheres, 0.2, 0.3));
  for (const auto& [name, surface] : cases) {
    REQUIRE(fit_ellipsoids(surface.patches).size() == 1);
    const Tracer tracer({{surface, Solver::quadric}});
    long rays = 0, missed = 0, passed = 0;
    for (int k = 0; k < 6000; ++k) {
      const Net& net = surface.patches[random() % surface.patches.size()];
      const dvec3 corner = net_point(net, static_cast<double>(k % 2), static_cast<double>(k / 2 % 2));
      const dvec3 beside = std::pow(10.0, -16.0 + 6.0 * part(random)) * random_direction(random),
                  target = glm::normalize(corner + beside),
                  from = glm::normalize(target + 0.8 * random_direction(random));
      const Ray ray{target + 3.0 * from, -from};
      ++rays;
      const Hit hit = tracer.closest(ray);
      missed += !(hit && glm::distance(hit.point, target) < 1e-13), passed += !tracer.occluded(ray);
    }
    INFO(name << ", " << rays << " rays");
    CHECK(missed == 0);
    CHECK(passed == 0);
  }
}

// Several surfaces are met through a hierarchy, which must let by what one sphere alone would meet.
TEST_CASE("Rays from 2^53 radii away meet spheres in company as alone", "[solvers]") {
  const TracedSurface cube{build_family(R"({"type": "sphere_tiling", "topology": "cube"})"), Solver::quadric};
  const Tracer alone({cube}), company({cube, cube, cube});
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  long hits = 0, differ = 0;
  for (int k = 0; k < 20'000; ++k) {
    const dvec3 d = random_direction(random);
    const dvec3 origin = random_direction(random) - std::exp2(50.0 + 6.0 * part(random)) * d;
    const Ray ray{origin, random_direction(random) - origin};
    const Hit one = alone.closest(ray), other = company.closest(ray);
    hits += static_cast<bool>(one), differ += one.t != other.t;
  }
  INFO(hits << " hits");
  CHECK(differ == 0);
  CHECK(hits > 5000);
}

}  // namespace rondure
