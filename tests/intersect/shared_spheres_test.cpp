// Tilings of a scene that are alike but for a rotation and their size share what is known of their patches;
// each is met as its own nets have it.

#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/mapped.h"
#include "tests/intersect/random_direction.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

using namespace rondure;

namespace {

constexpr double ulp = 0x1p-52;

Surface cube() { return build_family(R"({"type": "sphere_tiling", "topology": "cube"})"); }
Surface octants() { return build_family(R"({"type": "sphere_octant"})"); }

// Copies of the tiling, `count` of them, each turned and stretched in its own way, at a place of its own.
std::vector<Surface> copies(const Surface& tiling, int count, const dvec3& stretch, const dvec3& aside,
                            std::mt19937_64& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<Surface> out;
  for (int k = 0; k < count; ++k) {
    const dmat4 turn = glm::rotate(dmat4(1.0), 6.3 * part(random), random_direction(random));
    Surface surface = mapped(tiling, turn * glm::scale(dmat4(1.0), (0.5 + part(random)) * stretch));
    surface.origin = aside + dvec3(8.0 * k, 0.0, 0.0);
    out.push_back(std::move(surface));
  }
  return out;
}

double bytes_a_surface(const std::vector<Surface>& surfaces) {
  std::vector<TracedSurface> traced;
  double nets = 0.0;
  for (const Surface& surface : surfaces) {
    traced.push_back({surface, Solver::quadric});
    for (const Net& net : surface.patches)
      nets += static_cast<double>(sizeof(Net) + points_of(net).size() * sizeof(dvec4));
  }
  return (static_cast<double>(Tracer(std::move(traced)).statistics().bytes) - nets) /
         static_cast<double>(surfaces.size());
}

}  // namespace

TEST_CASE("Tilings that are alike share their grid, and each is met on its own nets", "[solvers]") {
  std::mt19937_64 random(11);
  std::vector<Surface> surfaces;
  const std::vector<std::vector<Surface>> groups = {
      copies(cube(), 30, dvec3(1.0), dvec3(0.0, 0.0, 0.0), random),
      copies(cube(), 30, dvec3(1.0, 1.5, 2.0), dvec3(0.0, 12.0, 0.0), random),
      copies(octants(), 30, dvec3(1.0), dvec3(0.0, 24.0, 0.0), random),
      copies(octants(), 30, dvec3(1.0, 1.5, 2.0), dvec3(0.0, 36.0, 0.0), random)};
  for (const std::vector<Surface>& group : groups) {
    // One grid takes 200 kB or more.
    CHECK(bytes_a_surface(group) < 0.1 * bytes_a_surface({group[0]}));
    surfaces.insert(surfaces.end(), group.begin(), group.end());
  }
  std::vector<TracedSurface> by_quadric, by_newton;
  for (const Surface& surface : surfaces) {
    by_quadric.push_back({surface, Solver::quadric});
    by_newton.push_back({surface, Solver::newton});
  }
  const Tracer quadric(std::move(by_quadric)), newton(std::move(by_newton));
  REQUIRE(quadric.statistics().leaves == surfaces.size());

  long hits = 0, differ = 0;
  WorstCase on_patch, t;
  std::string first = "none";
  for (int k = 0; k < 40'000; ++k) {
    const Surface& surface = surfaces[random() % surfaces.size()];
    const Net& aim = surface.patches[random() % surface.patches.size()];
    // Every third at a corner or a side, to rounding.
    std::uniform_real_distribution<double> part(0.0, 1.0);
    dvec2 uv(part(random), part(random));
    if (k % 3 == 0) uv = dvec2(k % 2, k % 9 == 0 ? 0.0 : uv.y);
    if (std::holds_alternative<TriangleNet>(aim) && uv.x + uv.y > 1.0) uv = dvec2(uv.x, 1.0 - uv.x);
    const dvec3 target = net_point(aim, uv.x, uv.y), from = 3.0 * random_direction(random);
    const Ray ray{surface.origin + from, target - from};
    const std::vector<Hit> a = newton.all(ray), b = quadric.all(ray);
    const auto describe = [&] { return fmt::format("ray {}: {} and {} hits", k, a.size(), b.size()); };
    if (a.size() != b.size()) {
      ++differ;
      if (first == "none") first = describe();
      continue;
    }
    for (std::size_t j = 0; j < a.size(); ++j) {
      ++hits;
      const Hit& hit = b[j];
      t.add(std::fabs(a[j].t - hit.t), a[j].t_error + hit.t_error, describe);
      const Surface& met = surfaces[static_cast<std::size_t>(hit.surface)];
      const dvec3 shown =
          net_point(met.patches[static_cast<std::size_t>(hit.patch)], hit.u, hit.v) + met.origin;
      // 16 ulps as of a surface alone (quadric_test.cpp), of semi-axes up to 3 and three times the shortest,
      // and those of the origin.
      on_patch.add(glm::distance(shown, hit.point), ulp * (16.0 * 3.0 * 3.0 + glm::length(met.origin)),
                   describe);
    }
  }
  INFO(hits << " hits; " << differ << " rays with others, the first: " << first);
  INFO("on the patch: " << on_patch.text());
  INFO("t: " << t.text());
  CHECK(differ == 0);
  CHECK(on_patch.failures() == 0);
  CHECK(t.failures() == 0);
  CHECK(hits > 40'000);
}

TEST_CASE("Many spheres in one surface are each found, and quickly", "[solvers]") {
  // Turned and moved in their nets.
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  constexpr int side = 7, spheres = side * side * side;
  const Surface tiling = cube();
  Surface surface;
  std::vector<dvec3> centers;
  for (int k = 0; k < spheres; ++k) {
    const dvec3 center = 3.0 * dvec3(k % side, k / side % side, k / (side * side));
    dmat4 map = glm::translate(dmat4(1.0), center) *
                glm::rotate(dmat4(1.0), 6.3 * part(random), random_direction(random));
    centers.push_back(center);
    for (const Net& net : mapped(tiling, map).patches) surface.patches.push_back(net);
  }
  const Tracer tracer({{surface, Solver::quadric}});
  CHECK(tracer.statistics().leaves == spheres);
  long hits = 0, wrong = 0;
  for (int k = 0; k < 20'000; ++k) {
    const std::size_t aim = random() % centers.size();
    const dvec3 from = 1.4 * random_direction(random);
    const Hit hit = tracer.closest({centers[aim] + from, 0.9 * random_direction(random) - from});
    if (!hit) {
      ++wrong;
      continue;
    }
    ++hits;
    const auto patch = static_cast<std::size_t>(hit.patch);
    const dvec3& center = centers[patch / tiling.patches.size()];
    // A net's rounding is that of its place.
    const double bound = 16.0 * ulp * (1.0 + glm::length(center));
    wrong += !(glm::distance(net_point(surface.patches[patch], hit.u, hit.v), hit.point) < bound &&
               std::fabs(glm::distance(hit.point, center) - 1.0) < bound);
  }
  INFO(wrong << " wrong of " << hits + wrong);
  CHECK(wrong == 0);
  CHECK(hits == 20'000);
}
