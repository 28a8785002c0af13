// The quadric solver against Newton's method: the same patches, parameters and normals on spheres and
// ellipsoids, whole and open, and nothing else on what is neither.

#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/transform.h"
#include "renderer/intersect/ellipsoid_fit.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/mapped.h"
#include "tests/intersect/placed.h"
#include "tests/intersect/random_direction.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

using namespace rondure;

namespace {

constexpr double ulp = 0x1p-52;

struct Case {
  std::string name;
  Surface surface;
  double size = 1.0;    // semi-axes are of this order
  double aspect = 1.0;  // longest over shortest
};

std::vector<Case> cases() {
  const Surface cube = build_family(R"({"type": "sphere_tiling", "topology": "cube"})"),
                octants = build_family(R"({"type": "sphere_octant"})");
  dmat4 skew(dvec4(1.3, 0.2, 0.1, 0), dvec4(-0.3, 0.8, 0.4, 0), dvec4(0.1, -0.2, 0.6, 0),
             dvec4(0.5, -2.0, 1.0, 1));
  std::vector<Case> out = {
      {"cube", cube},
      {"hemispheres", build_family(R"({"type": "sphere_tiling", "topology": "hemispheres"})")},
      {"octants", octants},
      {"icosahedron", build_family(R"({"type": "sphere_tiling", "topology": "icosahedron_quads"})")},
      {"rhombicuboctahedron",
       build_family(R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron"})")},
      {"three octants", build_family(R"({"type": "sphere_octant", "octants": [0, 3, 5]})")},
      {"cap", build_family(R"({"type": "sphere_cap", "z_max": -0.3})")},
      {"quadrilateral",
       build_family(
           R"({"type": "spherical_quad", "corners": [[3, 0, -0.5], [0.2, 2, -0.4], [-1, 0.5, 1], [0.3, -1, 0.2]]})")},
      {"tiny cube", placed(cube, 1e-7, dvec3(0.0)), 1e-7},
      {"skew cube", mapped(cube, skew), 1.0, 3.0},
      {"skew octants", mapped(octants, skew), 1.0, 3.0}};
  for (const char* name : {"hemispheres", "octahedron_quads"}) {
    const Surface tiling =
        build_family(fmt::format(R"({{"type": "sphere_tiling", "topology": "{}"}})", name));
    const dmat4 turn = glm::rotate(dmat4(1.0), glm::radians(40.0), glm::normalize(dvec3(1.0, 2.0, 3.0)));
    out.push_back({fmt::format("turned {}", name), mapped(tiling, turn)});
    out.push_back({fmt::format("stretched {}", name),
                   mapped(tiling, turn * glm::scale(dmat4(1.0), dvec3(1.0, 2.0, 3.0))), 3.0, 3.0});
  }
  dmat4 flat(1.0);
  flat[2][2] = 0.01;
  out.push_back({"flat cube", mapped(cube, flat), 1.0, 100.0});
  return out;
}

}  // namespace

TEST_CASE("A seam between patches of which each has an ellipsoid of its own loses no grazing ray",
          "[solvers]") {
  // Octants, those below flattened by half: across the equator the normal is the same, but each half meets a
  // ray at a place of its own, rounding over the cosine away: beside its domain for both.
  Surface surface = build_family(R"({"type": "sphere_octant"})");
  for (Net& net : surface.patches)
    if (net_point(net, 0.5, 0.25).z < 0.0)
      for (dvec4& p : points_of(net)) p.z *= 0.5;
  REQUIRE(fit_ellipsoids(surface.patches).size() == 2);
  const Tracer tracer({{surface, Solver::quadric}});
  std::mt19937_64 random(19);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  long rays = 0, odd = 0;
  for (int k = 0; k < 200'000; ++k) {
    const double angle = 6.3 * part(random);
    const dvec3 normal(std::cos(angle), std::sin(angle), 0.0);
    // At a slope of 10^-6.5 the chord is 10^-13 deep, twenty times the band of tangency.
    const double slope = std::pow(10.0, -1.0 - 5.5 * part(random));
    const dvec3 direction = glm::normalize(glm::cross(normal, random_direction(random))) + slope * normal;
    ++rays;
    odd += tracer.all({normal - 3.0 * direction, direction}).size() % 2;
  }
  INFO(odd << " of " << rays);
  CHECK(odd == 0);
}

TEST_CASE("The quadric solver agrees with Newton's method, hit by hit", "[solvers]") {
  long rays = 0, hits = 0, counts_differ = 0, other_patch = 0;
  std::string worst = "none";
  WorstCase t, normal, parameter, on_patch;
  for (const Case& c : cases()) {
    REQUIRE(fit_ellipsoids(c.surface.patches).size() == 1);
    const Tracer newton({{c.surface, Solver::newton}}), quadric({{c.surface, Solver::quadric}});
    CHECK(quadric.statistics().leaves == 1);
    std::mt19937_64 random(41);
    dvec3 middle(0.0);
    for (const Net& net : c.surface.patches)
      middle += net_point(net, 0.5, 0.25) / static_cast<double>(c.surface.patches.size());
    for (int k = 0; k < 6000; ++k) {
      const dvec3 d = random_direction(random), e = random_direction(random);
      const double near = std::uniform_real_distribution<double>(0.0, 1.0)(random);
      // From outside and inside, at the surface.
      const dvec3 origin = middle + (k % 3 == 0 ? 0.5 : 4.0) * c.size * d;
      const Ray ray{origin, middle + c.size * near * e - origin};
      const std::vector<Hit> a = newton.all(ray), b = quadric.all(ray);
      ++rays;
      const auto describe = [&] {
        return fmt::format("{}: o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g}): {} and {}",
                           c.name, ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
                           ray.direction.z, a.size(), b.size());
      };
      if (a.size() != b.size()) {
        ++counts_differ, worst = describe();
        continue;
      }
      hits += static_cast<long>(a.size());
      for (std::size_t j = 0; j < a.size(); ++j) {
        t.add(std::fabs(a[j].t - b[j].t), a[j].t_error + b[j].t_error, describe);
        const double cosine = std::fabs(glm::dot(a[j].normal, ray.direction)) / glm::length(ray.direction);
        // Both points are within some ulps of the surface at right angles to the ray; along it, and so in
        // normal and parameters, that is stretched. 32 ulps: 8 of either's position, twice for the normal's
        // turn over the shorter semi-axis.
        const double bound = 32.0 * ulp * c.aspect * c.aspect / std::max(cosine, 1e-7);
        if (a[j].patch != b[j].patch) {
          // On a seam either may be told: the point must be the same.
          const Net& net = c.surface.patches[static_cast<std::size_t>(b[j].patch)];
          other_patch += !(glm::distance(net_point(net, b[j].u, b[j].v), a[j].point) < bound * c.size);
          continue;
        }
        const SurfaceJet jet =
            surface_jet(c.surface.patches[static_cast<std::size_t>(b[j].patch)], b[j].u, b[j].v);
        on_patch.add(glm::distance(jet.point, b[j].point), 16.0 * ulp * c.size * c.aspect, describe);
        const double sine =
            glm::length(glm::cross(jet.du, jet.dv)) / (glm::length(jet.du) * glm::length(jet.dv));
        // Newton's own normal comes from the parameters, and those from tangents that may be nearly parallel.
        normal.add(glm::distance(a[j].normal, b[j].normal), bound * (1.0 + 1.0 / std::max(sine, 1e-7)),
                   describe);
        const double off_u = std::fabs(a[j].u - b[j].u) * glm::length(jet.du),
                     off_v = std::fabs(a[j].v - b[j].v) * glm::length(jet.dv);
        parameter.add(std::max(off_u, off_v), bound * c.size / std::max(sine, 1e-7), describe);
      }
    }
  }
  INFO(rays << " rays, " << hits << " hits; " << worst);
  INFO("t: " << t.text());
  INFO("normal: " << normal.text());
  INFO("parameters: " << parameter.text());
  INFO("on the patch: " << on_patch.text());
  CHECK(counts_differ == 0);
  CHECK(other_patch == 0);
  CHECK(t.failures() == 0);
  CHECK(normal.failures() == 0);
  CHECK(parameter.failures() == 0);
  CHECK(on_patch.failures() == 0);
  CHECK(hits > rays / 2);
}

TEST_CASE("Ellipsoids are found for what they are", "[solvers]") {
  const Surface cube = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  const std::vector<EllipsoidFit> unit = fit_ellipsoids(cube.patches);
  REQUIRE(unit.size() == 1);
  CHECK(unit[0].linear == dmat3(1.0));
  CHECK(unit[0].center == dvec3(0.0));
  CHECK(unit[0].patches.size() == 6);

  // Two spheres and a plane in one surface.
  Surface mixed = cube;
  const dvec3 away(3.0, 0.5, -1.0);
  for (const Net& net : cube.patches) {
    mixed.patches.push_back(net);
    for (dvec4& p : points_of(mixed.patches.back())) p = dvec4(0.5 * dvec3(p) + away * p.w, p.w);
  }
  mixed.patches.push_back(build_family(R"({"type": "bezier", "patches": [{"kind": "tensor", "degree": [1, 1],
      "net": [[[-1, -1, 3, 1], [-1, 1, 3, 1]], [[1, -1, 3, 1], [1, 1, 3, 1]]]}]})")
                              .patches[0]);
  const std::vector<EllipsoidFit> two = fit_ellipsoids(mixed.patches);
  REQUIRE(two.size() == 2);
  CHECK(two[0].patches.size() == 6);
  CHECK(two[1].patches.size() == 6);
  CHECK(glm::distance(two[1].center, away) < 4.0 * ulp * glm::length(away));
  const Tracer tracer({{mixed, Solver::quadric}});
  CHECK(tracer.all({dvec3(0.1, 0.2, 5.0), dvec3(0.0, 0.0, -1.0)}).size() == 3);

  // What bulges by 10^-13 is no sphere.
  Surface bulging = cube;
  points_of(bulging.patches[0])[12].x += 1e-13;
  for (const EllipsoidFit& fit : fit_ellipsoids(bulging.patches))
    CHECK(std::find(fit.patches.begin(), fit.patches.end(), 0u) == fit.patches.end());
  CHECK(fit_ellipsoids(build_family(R"({"type": "iss"})").patches).empty());
}

// Whatever turned or stretched them in doubles: the bound is one on the quotient of the defect and the
// squared weight, not on the defect over the least weight, which hemispheres (weights from 1/8) would miss.
// Where control points are many times as far away as the patch, as theirs are, rounding of some turns does
// exceed it.
TEST_CASE("Tilings that were turned, stretched and moved lie on one ellipsoid", "[solvers]") {
  std::mt19937_64 random(131);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  constexpr int maps = 60;
  for (const auto& [object, most] : std::initializer_list<std::pair<const char*, int>>{
           {R"({"type": "sphere_tiling", "topology": "cube"})", 0},
           {R"({"type": "sphere_tiling", "topology": "octahedron_quads"})", 0},
           {R"({"type": "sphere_octant"})", 0},
           {R"({"type": "sphere_tiling", "topology": "icosahedron_quads"})", 0},
           {R"({"type": "sphere_tiling", "topology": "hemispheres"})", 1}}) {
    const Surface surface = build_family(object);
    int apart = 0;
    std::string first = "none";
    for (int k = 0; k < maps; ++k) {
      dmat4 map(1.0);
      if (k % 4 > 1) map = glm::scale(map, std::exp2(3.0 * part(random)) * dvec3(1.0, 2.0, 3.0));
      map = glm::rotate(dmat4(1.0), 6.3 * part(random), random_direction(random)) * map;
      if (k % 2 > 0) map[3] = dvec4(5.0 * random_direction(random), 1.0);
      const Surface moved = mapped(surface, map);
      const std::vector<EllipsoidFit> fits = fit_ellipsoids(moved.patches);
      if (fits.size() == 1 && fits[0].patches.size() == moved.patches.size()) continue;
      ++apart;
      if (first == "none") first = fmt::format("map {}: {} ellipsoids", k, fits.size());
    }
    INFO(object << ": " << apart << " of " << maps << "; first: " << first);
    CHECK(apart <= most);
  }
}

// Where the sides of octants collapse, as near as doubles tell apart: each turn rounds the four nets that
// meet there in another way.
TEST_CASE("The poles of octants are met whichever way they are turned", "[solvers]") {
  const Surface octants = build_family(R"({"type": "sphere_octant"})");
  std::mt19937_64 random(97);
  long rays = 0, missed = 0, passed = 0;
  std::string first = "none";
  for (int turn = 0; turn < 24; ++turn) {
    const dvec3 axis = random_direction(random);
    const dmat4 map = glm::rotate(dmat4(1.0), 0.3 + turn, axis);
    const Surface surface = mapped(octants, map);
    const Tracer tracer({{surface, Solver::quadric}});
    for (std::size_t patch = 0; patch < surface.patches.size(); ++patch) {
      for (int i = 0; i <= 10; ++i) {
        for (double d = 1e-17; d < 0.1; d *= 3.0) {
          const dvec3 target = net_point(surface.patches[patch], i / 10.0, 1.0 - d);
          const dvec3 from = glm::normalize(glm::normalize(target) + 0.8 * random_direction(random));
          const Ray ray{target + 3.0 * from, -from};
          ++rays;
          const Hit hit = tracer.closest(ray);
          const bool found = hit && glm::distance(hit.point, target) < 1e-14;
          missed += !found, passed += !tracer.occluded(ray);
          if (!found && first == "none")
            first = fmt::format("turn {} patch {} u {} d {}", turn, patch, i / 10.0, d);
        }
      }
    }
  }
  INFO("first missed: " << first);
  CHECK(missed == 0);
  CHECK(passed == 0);
  CHECK(rays > 60000);
}
