// The single-precision hierarchy must offer every leaf that a double-precision ray meets: against all leaves,
// one by one.

#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <random>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/leaf.h"
#include "renderer/intersect/solve_leaf.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/placed.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

namespace {

// Layouts that are hard on float boxes: big and small together, far from the origin, flat, needle-thin.
std::vector<std::pair<const char*, std::vector<TracedSurface>>> layouts() {
  const Surface cube = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  const Surface octant = build_family(R"({"type": "sphere_octant", "octants": [0]})");
  const Surface plane = build_family(R"({"type": "bezier", "patches": [{"kind": "tensor", "degree": [1, 1],
      "net": [[[-1, -1, 0, 1], [-1, 1, 0, 1]], [[1, -1, 0, 1], [1, 1, 0, 1]]]}]})");
  const auto flattened = [](Surface s, dvec3 scale) {
    for (Net& net : s.patches)
      for (dvec4& p : points_of(net)) p *= dvec4(scale, 1.0);
    return s;
  };
  const auto traced = [](std::vector<Surface> surfaces) {
    std::vector<TracedSurface> out;
    for (Surface& s : surfaces) out.push_back({std::move(s), Solver::newton});
    return out;
  };
  const dvec3 far(1e7, -2e7, 3e7);
  return {
      {"big and small", traced({placed(cube, 1e4, dvec3(0.0)), placed(cube, 1e-3, dvec3(1.0, 2.0, 3.0))})},
      {"small, on a big plane",
       traced({placed(plane, 1e5, dvec3(0.0)), placed(cube, 1e-2, dvec3(300.0, 0.0, 1e-2))})},
      {"far from the origin",
       traced({placed(cube, 1.0, far), placed(octant, 3.0, far + dvec3(2.0, 0.0, 0.0))})},
      {"flat", traced({flattened(cube, dvec3(1.0, 1.0, 1e-7)), flattened(cube, dvec3(1e-7, 1.0, 1.0))})},
      {"needles",
       traced({flattened(cube, dvec3(1e-6, 1e-6, 1.0)), flattened(octant, dvec3(1.0, 1e-5, 1e-6))})}};
}

// t of every root on every leaf, without boxes.
std::vector<double> brute_force(const std::vector<TracedSurface>& surfaces, const std::vector<LeafSet>& sets,
                                const Ray& ray) {
  std::vector<double> found;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    LocalRay local;
    if (!make_local_ray(ray.origin, ray.direction, surfaces[k].surface.origin, local)) continue;
    for (const Leaf& leaf : sets[k].leaves) {
      const Net& net = surfaces[k].surface.patches[static_cast<std::size_t>(leaf.patch)];
      std::vector<Root> roots;
      SolverCounts counts;
      NewtonRoot one;
      const NewtonVerdict verdict = solve_by_newton(leaf, net, newton_patch(net), local, one, counts);
      if (verdict == NewtonVerdict::root) roots.push_back(one.root);
      if (verdict == NewtonVerdict::undecided) search_leaf(leaf, net, local, roots, counts);
      for (const Root& root : roots) {
        const dvec3 point = net_point(net, root.u, root.v);
        const double t =
            (local.slide + glm::dot(point - local.base, local.direction) / local.length2) * local.scale;
        if (t >= 0.0) found.push_back(t);
      }
    }
  }
  return found;
}

}  // namespace

TEST_CASE("The hierarchy loses no leaf that a double ray meets", "[hits]") {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  long roots = 0, lost = 0, rays = 0;
  std::string worst = "none";
  for (const auto& [name, surfaces] : layouts()) {
    const Tracer tracer(surfaces);
    std::vector<LeafSet> sets;
    for (const TracedSurface& traced : surfaces) sets.push_back(build_leaves(traced.surface.patches, 11));
    for (int k = 0; k < 800; ++k) {
      // At a point of one of the surfaces, from near or far, straight, along an axis or grazing.
      const TracedSurface& aim = surfaces[static_cast<std::size_t>(k) % surfaces.size()];
      const auto patch =
          static_cast<std::size_t>(uniform(random) * static_cast<double>(aim.surface.patches.size()));
      const double u = uniform(random), v = uniform(random);
      const Net& net = aim.surface.patches[patch];
      const dvec3 target = aim.surface.origin + net_point(net, u, v);
      const double x = normal(random), y = normal(random), z = normal(random),
                   distance = std::pow(10.0, 8.0 * uniform(random) - 2.0);
      dvec3 direction = glm::normalize(dvec3(x, y, z));
      if (k % 4 == 1) direction = dvec3(k % 3 == 0, k % 3 == 1, k % 3 == 2);
      if (k % 4 == 2)
        direction = glm::normalize(glm::cross(direction, unit_normal(net, u, v)) + 1e-6 * direction);
      const Ray ray{target - distance * direction, direction};
      const std::vector<Hit> hits = tracer.all(ray);
      ++rays;
      for (const double t : brute_force(surfaces, sets, ray)) {
        ++roots;
        bool known = false;
        for (const Hit& hit : hits) known = known || std::fabs(hit.t - t) <= 2.0 * hit.t_error + 0x1p-50 * t;
        if (known) continue;
        ++lost;
        worst = fmt::format(
            "{}: o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g}), t = {:.17g}", name,
            ray.origin.x, ray.origin.y, ray.origin.z, direction.x, direction.y, direction.z, t);
      }
    }
  }
  INFO(rays << " rays, " << roots << " roots; lost: " << worst);
  CHECK(lost == 0);
  CHECK(roots > rays);
}
