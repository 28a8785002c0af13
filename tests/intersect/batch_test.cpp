// Many rays at once get the bits that each gets alone, on every instruction set of the machine, and those
// that the solver gives without any.

#include <fmt/core.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <random>

#include "renderer/intersect/solve_leaf.h"
#include "renderer/intersect/sphere_packets.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/placed.h"
#include "tests/intersect/random_direction.h"
#include "tests/intersect/same_bits.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

namespace {

// From outside, inside and far away, past the sphere, along its rim, of any length; some odd.
std::vector<Ray> rays_at(double radius, const dvec3& center, std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Ray> rays;
  for (std::size_t k = 0; k < count; ++k) {
    const dvec3 d = random_direction(random), e = random_direction(random);
    const double a = uniform(random), b = uniform(random);
    const double distance = k % 5 == 0 ? 0.9 * a : k % 5 == 1 ? 1e6 : 1.0 + 3.0 * a;
    Ray ray;
    ray.origin = center + radius * distance * d;
    ray.direction =
        (center + radius * (k % 7 == 0 ? 1.5 : 0.999) * b * e - ray.origin) * std::exp2(40.0 * a - 20.0);
    if (k % 11 == 0) ray.t_max = a * std::exp2(20.0 - 40.0 * a);
    if (k % 13 == 0) ray.start = {0, d};
    if (k % 101 == 0) ray.direction = dvec3(0.0);
    if (k % 103 == 0) ray.origin.x = NAN;
    if (k % 107 == 0) ray.direction *= std::exp2(-1000.0);
    // From 10^12 to 10^16 radii away, where the way there is longer than doubles resolve.
    if (k % 29 == 7) {
      const dvec3 far = radius * std::pow(10.0, 12.0 + 4.0 * a) * d;
      ray.direction = ray.direction - (center + far - ray.origin), ray.origin = center + far;
    }
    rays.push_back(ray);
  }
  return rays;
}

// The same in bundles that go much the same way, some more so than others: towards one point from one place.
std::vector<Ray> bundles_at(double radius, const dvec3& center, std::size_t count, std::mt19937_64& random) {
  constexpr std::size_t size = 48;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Ray> rays;
  for (std::size_t k = 0; rays.size() < count; ++k) {
    const std::vector<Ray> first = rays_at(radius, center, 1 + k % 14, random);
    const double apart = std::exp2(-1.0 - 12.0 * uniform(random));
    // A few of every kind, and the rest about the last.
    const Ray& middle = first.back();
    for (std::size_t j = 0; j < size && rays.size() < count; ++j) {
      Ray ray = middle;
      const double length = glm::length(middle.direction);
      ray.origin += 0.3 * radius * apart * random_direction(random);
      ray.direction += length * apart * uniform(random) * random_direction(random);
      if (j % 17 == 3) ray = first.front();
      // Next to nothing along an axis, beside others that go either way.
      if (j % 23 == 9)
        ray.direction[static_cast<int>(k % 3)] = -length * std::pow(10.0, -15.0 - 20.0 * apart);
      if (j % 19 == 5) ray.t_min = length > 0.0 ? radius / length : 0.0;
      rays.push_back(ray);
    }
  }
  return rays;
}

struct Scene {
  const char* name;
  std::vector<TracedSurface> surfaces;
  double radius;
  dvec3 center;
  bool bundled = false;
};

std::vector<Scene> scenes() {
  std::vector<Scene> out;
  const dvec3 aside(3.1, -2.7, 10.3);
  for (const char* object :
       {R"({"type": "sphere_tiling", "topology": "cube"})",
        R"({"type": "sphere_tiling", "topology": "hemispheres"})", R"({"type": "sphere_octant"})",
        R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron"})",
        R"({"type": "sphere_octant", "octants": [0, 3, 6]})", R"({"type": "sphere_cap", "z_max": -0.2})",
        R"({"type": "sphere"})"}) {
    out.push_back({object, {{build_family(object), Solver::quadric}}, 1.0, dvec3(0.0)});
    out.push_back({object, {{placed(build_family(object), 0.37, aside), Solver::quadric}}, 0.37, aside});
  }
  Surface egg = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  for (Net& net : egg.patches)
    for (dvec4& p : points_of(net)) p.z *= 1.4;
  out.push_back({"egg", {{egg, Solver::quadric}}, 1.0, dvec3(0.0)});
  Surface analytic_egg;
  analytic_egg.ellipsoid = dmat3(1.0), (*analytic_egg.ellipsoid)[2][2] = 1.4;
  out.push_back({"analytic egg", {{analytic_egg, Solver::newton}}, 1.0, dvec3(0.0)});
  const Surface cube = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  out.push_back({"three",
                 {{placed(cube, 0.5, dvec3(0.4, 0.0, 0.0)), Solver::quadric},
                  {placed(cube, 0.5, dvec3(-0.4, 0.0, 0.0)), Solver::quadric},
                  {placed(cube, 0.5, dvec3(0.0, 0.0, 0.5)), Solver::newton}},
                 1.0,
                 dvec3(0.0)});
  for (const char* object :
       {R"({"type": "sphere_tiling", "topology": "cube"})",
        R"({"type": "sphere_tiling", "topology": "hemispheres"})", R"({"type": "sphere_octant"})",
        R"({"type": "sphere_octant", "octants": [0, 3, 6]})",
        R"({"type": "sphere_tiling", "topology": "octahedron_pairs"})",
        R"({"type": "iss", "octants": {"degree": 7, "interior": 1}})"}) {
    out.push_back({object, {{build_family(object), Solver::newton}}, 1.0, dvec3(0.0), true});
    out.push_back({object, {{placed(build_family(object), 0.37, aside), Solver::newton}}, 0.37, aside, true});
    out.push_back(
        {object, {{placed(build_family(object), 1e-6, dvec3(0.0)), Solver::newton}}, 1e-6, dvec3(0.0), true});
  }
  // Of degrees that no kernel is made for, one of them flat and crossed by the other.
  Surface plates;
  for (const double bend : {0.0, 0.4}) {
    TensorNet net(1, 3);
    for (int i = 0; i <= 1; ++i)
      for (int j = 0; j <= 3; ++j)
        net.at(i, j) = dvec4(i - 0.5, j / 3.0 - 0.5, bend * (j % 2 - 0.5) * (i - 0.2), 1.0);
    plates.patches.push_back(net);
  }
  out.push_back({"plates", {{plates, Solver::newton}}, 0.7, dvec3(0.0), true});
  out.push_back({"three nets",
                 {{placed(cube, 0.5, dvec3(0.4, 0.0, 0.0)), Solver::newton},
                  {placed(egg, 0.5, dvec3(-0.4, 0.0, 0.0)), Solver::newton},
                  {placed(plates, 0.7, dvec3(0.0, 0.0, 0.5)), Solver::newton}},
                 1.0,
                 dvec3(0.0),
                 true});
  return out;
}

}  // namespace

TEST_CASE("Rays met together get the bits that each gets alone, on every instruction set", "[hits][batch]") {
  std::mt19937_64 random(59);
  for (const Scene& scene : scenes()) {
    const Tracer tracer(scene.surfaces);
    // Beside other surfaces, far away, the same sphere is met through a hierarchy.
    std::vector<TracedSurface> with_others = scene.surfaces;
    for (int k = 0; k < 3; ++k)
      with_others.push_back(
          {placed(build_family(R"({"type": "sphere"})"), 1e-3, scene.center + 50.0 * (k + 1.0)),
           Solver::newton});
    const Tracer crowded(with_others);
    const std::vector<Ray> rays =
        (scene.bundled ? bundles_at : rays_at)(scene.radius, scene.center, 3000, random);
    std::vector<Hit> expected;
    long hits = 0, wrong = 0;
    thread_counts() = {};
    for (const Ray& ray : rays) {
      // Of all hits: these are sought without shortcuts.
      const std::vector<Hit> all = crowded.all(ray);
      expected.push_back(all.empty() ? Hit{} : all.front()), hits += !all.empty();
    }
    const std::vector<std::string> sets = instruction_sets();
    REQUIRE(!sets.empty());
    for (const std::string& set : sets) {
      use_instruction_set(set);
      for (const std::size_t width : {1, 2, 7, 8, 16, 33}) {
        std::vector<Hit> together(rays.size());
        for (std::size_t first = 0; first < rays.size(); first += width) {
          const std::size_t count = std::min(width, rays.size() - first);
          tracer.closest(std::span(rays).subspan(first, count), std::span(together).subspan(first, count));
        }
        for (std::size_t k = 0; k < rays.size(); ++k) wrong += !same_bits(together[k], expected[k]);
      }
      for (std::size_t k = 0; k < rays.size(); ++k) {
        wrong += !same_bits(tracer.closest(rays[k]), expected[k]);
        wrong += !same_bits(crowded.closest(rays[k]), expected[k]);
        wrong += tracer.occluded(rays[k]) != static_cast<bool>(expected[k]);
        wrong += crowded.occluded(rays[k]) != static_cast<bool>(expected[k]);
      }
    }
    use_instruction_set("");
    const auto occluded = std::make_unique<bool[]>(rays.size());
    tracer.occluded(rays, std::span(occluded.get(), rays.size()));
    for (std::size_t k = 0; k < rays.size(); ++k) wrong += occluded[k] != static_cast<bool>(expected[k]);
    const std::size_t in_company = thread_counts().met_in_packets;
    INFO(scene.name << ": " << sets.size() << " instruction sets, the first " << sets.front() << ", "
                    << in_company << " rays in company");
    CHECK(wrong == 0);
    // Of six widths on each instruction set; there are machines without.
    if (scene.bundled && sets.size() > 2) CHECK(in_company > rays.size());
    CHECK(hits > static_cast<long>(rays.size()) / 20);
  }
}
