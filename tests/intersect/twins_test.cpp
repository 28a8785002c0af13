// Surfaces that share their leaves: each is met as it is when alone, to the last bit.

#include "renderer/intersect/twins.h"

#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "tests/catch.h"
#include "tests/intersect/placed.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

namespace {

bool same(const Hit& a, const Hit& b) {
  return a.t == b.t && a.t_error == b.t_error && a.patch == b.patch && a.u == b.u && a.v == b.v &&
         a.point == b.point && a.normal == b.normal;
}

// 3 x 3 x 3 places, not exact in binary, of three sorts of surface; and one big surface about them.
std::vector<TracedSurface> crowd() {
  const Surface sorts[] = {build_family(R"({"type": "sphere_tiling", "topology": "cube"})"),
                           build_family(R"({"type": "sphere_octant", "octants": [0, 6]})"),
                           build_family(R"({"type": "sphere"})")};
  std::vector<TracedSurface> out;
  for (int k = 0; k < 27; ++k) {
    Surface surface = sorts[k % 3];
    surface.origin = dvec3(100.0, 0.0, 0.0) + 1.9 * dvec3(k % 3, k / 3 % 3, k / 9);
    out.push_back({std::move(surface), Solver::newton});
  }
  out.push_back({placed(sorts[1], 12.0, dvec3(100.0, 0.0, 0.0)), Solver::newton});
  return out;
}

}  // namespace

TEST_CASE("Surfaces are twins when only their places differ", "[twins]") {
  std::vector<TracedSurface> surfaces = crowd();
  const std::vector<unsigned> twins = find_twins(surfaces);
  for (unsigned k = 0; k < 27; ++k) CHECK(twins[k] == k % 3);
  CHECK(twins[27] == 27);
  // One bit of one point, or another solver, and they are none.
  points_of(surfaces[3].surface.patches[5]).back().x += 0x1p-50;
  surfaces[7].solver = Solver::clipping;
  const std::vector<unsigned> changed = find_twins(surfaces);
  CHECK(changed[3] == 3);
  CHECK(changed[7] == 7);
  CHECK(changed[6] == 0);
}

TEST_CASE("Twins are met as each is alone, to the last bit", "[hits][twins]") {
  const std::vector<TracedSurface> surfaces = crowd();
  const Tracer together(surfaces);
  std::vector<Tracer> alone;
  for (const TracedSurface& surface : surfaces) alone.emplace_back(std::vector<TracedSurface>{surface});
  CHECK(together.statistics().leaves == alone[0].statistics().leaves + alone[1].statistics().leaves +
                                            alone[2].statistics().leaves + alone[27].statistics().leaves);

  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  long rays = 0, hits = 0, different = 0;
  std::string worst = "none";
  for (int k = 0; k < 6000; ++k) {
    const auto place = [&](double reach) {
      const double x = uniform(random), y = uniform(random), z = uniform(random);
      return dvec3(101.9, 1.9, 1.9) + reach * (2.0 * dvec3(x, y, z) - 1.0);
    };
    Ray ray{place(k % 3 == 0 ? 1e3 : 3.0), dvec3(0.0)};
    ray.direction = place(3.0) - ray.origin;
    if (k % 5 == 0) ray.t_min = 0.3, ray.t_max = 1.1;

    std::vector<Hit> expected;
    for (unsigned s = 0; s < surfaces.size(); ++s)
      for (Hit hit : alone[s].all(ray)) hit.surface = static_cast<int>(s), expected.push_back(hit);
    std::sort(expected.begin(), expected.end(),
              [](const Hit& a, const Hit& b) { return a.t != b.t ? a.t < b.t : a.surface < b.surface; });
    const std::vector<Hit> all = together.all(ray);
    const Hit closest = together.closest(ray);
    ++rays;
    hits += static_cast<long>(all.size());
    bool agree = all.size() == expected.size() && static_cast<bool>(closest) == !expected.empty() &&
                 together.occluded(ray) == !expected.empty();
    for (std::size_t j = 0; agree && j < all.size(); ++j)
      agree = all[j].surface == expected[j].surface && same(all[j], expected[j]);
    if (agree && closest) agree = closest.surface == expected[0].surface && same(closest, expected[0]);
    if (agree) continue;
    ++different;
    worst = fmt::format("ray {}: {} hits, {} of the surfaces alone", k, all.size(), expected.size());
  }
  INFO(rays << " rays, " << hits << " hits; " << worst);
  CHECK(different == 0);
  CHECK(hits > 2 * rays);
}
