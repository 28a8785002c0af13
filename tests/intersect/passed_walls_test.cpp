// A path that is sent at an edge, within rounding, comes away from it.

#include "renderer/intersect/passed_walls.h"

#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "renderer/bezier/transform.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/boxes.h"
#include "tests/intersect/random_direction.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

namespace {

struct Corners {
  dvec3 low, high;
};
struct Bricks {
  const char* name;
  std::vector<Corners> boxes;
};

// About an edge through zero along y; the last about a vertex too.
std::vector<Bricks> bricks() {
  const Corners left{{-1, -1, -1}, {0, 1, 0}}, right{{0, -1, -1}, {1, 1, 0}},
      over_left{{-1, -1, 0}, {0, 1, 1}}, over_right{{0, -1, 0}, {1, 1, 1}}, over{{-1, -1, 0}, {1, 1, 1}};
  std::vector<Bricks> out = {{"one", {left}},
                             {"two in a row", {left, right}},
                             {"two at an edge", {left, over_right}},
                             {"one on two", {left, right, over}},
                             {"four", {left, right, over_left, over_right}}};
  Bricks eight{"eight", {}};
  for (int k = 0; k < 8; ++k) {
    const dvec3 low(k & 1 ? 0 : -1, k & 2 ? 0 : -1, k & 4 ? 0 : -1);
    eight.boxes.push_back({low, low + 1.0});
  }
  out.push_back(eight);
  return out;
}

}  // namespace

// Through a straight path's place lie all the walls of all boxes at most, each met once. One that is thrown
// back at each second wall, as from glass, comes away too.
TEST_CASE("A path comes away from an edge", "[hits]") {
  std::mt19937_64 random(77);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const double angle : {0.0, 0.7})
    for (const double away : {0.0, 100.0})
      for (const Bricks& scene : bricks()) {
        const dmat3 turn = turn_about(glm::normalize(dvec3(3.0, -1.0, 2.0)), angle);
        const dvec3 frame = away * dvec3(-0.546, -0.839, -0.026);
        std::vector<TracedSurface> surfaces;
        for (const Corners& c : scene.boxes) {
          surfaces.push_back({box(c.low, c.high, turn), Solver::newton});
          surfaces.back().surface.origin = frame;
        }
        const Tracer tracer(surfaces);
        const std::size_t walls = 6 * surfaces.size(), thrown = 50;
        long paths = 0, lost = 0, stuck = 0, stuck_thrown = 0, shadows = 0;
        std::size_t longest = 0;
        for (int k = 0; k < 2000; ++k) {
          const bool straight = k % 2 == 0;
          const dvec3 aside = std::pow(10.0, -17.0 + 5.0 * part(random)) * random_direction(random);
          const dvec3 target = turn * (dvec3(0.0, k % 4 < 2 ? 0.0 : part(random), 0.0) + aside);
          Ray ray{frame + target, random_direction(random)};
          ray.origin -= 5.0 * ray.direction;
          PassedWalls passed;
          std::size_t met = 0;
          for (; met <= (straight ? walls : 40 * thrown); ++met) {
            const Hit hit = tracer.closest(ray);
            shadows += tracer.occluded(ray) != static_cast<bool>(hit);
            if (!hit) break;
            passed.arrive(ray, hit);
            dvec3 direction = ray.direction;
            if (!straight && met < thrown && part(random) < 0.5)
              direction -= 2.0 * glm::dot(direction, hit.normal) * hit.normal;
            ray = Ray{hit.point, direction, 0.0, INFINITY, {hit.surface, hit.normal, &passed}};
          }
          ++paths, longest = std::max(longest, met), lost += met == 0;
          stuck += straight && met > walls, stuck_thrown += !straight && met > 40 * thrown;
        }
        INFO(scene.name << ", angle " << angle << ", " << away << " away: of " << paths << " paths " << stuck
                        << " straight ones and " << stuck_thrown
                        << " thrown ones do not come away, the longest of " << longest << " walls; " << lost
                        << " meet none");
        CHECK(stuck == 0);
        CHECK(stuck_thrown == 0);
        CHECK(shadows == 0);
        CHECK(lost < (scene.boxes.size() < 4 ? 3 * paths / 4 : paths / 100));
        CHECK(longest > 1);
      }
}

// Thinner than some roundings of the place, but not than one: what is thrown back within it meets the other
// side.
TEST_CASE("The two sides of a thin body are two walls", "[hits]") {
  std::mt19937_64 random(78);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const auto& [away, thick] : {std::pair(0.0, 1e-14), std::pair(1000.0, 1e-12)}) {
    Surface slab = box({-1.0, -1.0, 0.0}, {1.0, 1.0, thick}, dmat3(1.0));
    slab.origin = away * dvec3(1.0, -0.7, 0.3);
    const Tracer tracer({{slab, Solver::newton}});
    long paths = 0, hits = 0, wrong = 0;
    for (int k = 0; k < 2000; ++k) {
      Ray ray{slab.origin + dvec3(part(random) - 0.5, part(random) - 0.5, 0.0), random_direction(random)};
      if (std::fabs(ray.direction.z) < 0.3) continue;
      ray.origin -= 5.0 * ray.direction;
      PassedWalls passed;
      bool inside = false, right = true;
      for (int met = 0; met < 40; ++met) {
        const Hit hit = tracer.closest(ray);
        if (!hit) break;
        ++hits;
        right = right && (glm::dot(hit.normal, ray.direction) > 0.0) == inside;
        passed.arrive(ray, hit);
        dvec3 direction = ray.direction;
        if (part(random) < 0.5)
          direction -= 2.0 * glm::dot(direction, hit.normal) * hit.normal;
        else
          inside = !inside;
        ray = Ray{hit.point, direction, 0.0, INFINITY, {hit.surface, hit.normal, &passed}};
      }
      ++paths, wrong += !right || inside;
    }
    INFO(away << " away: of " << paths << " paths, of " << hits << " hits, " << wrong
              << " are in the wrong medium");
    CHECK(wrong == 0);
    CHECK(hits > paths);
  }
}

// Of an open surface some patches may face inward. On which side of such a wall a path is, goes by the normal
// that its hits have, not by the sphere's.
TEST_CASE("A wall of a sphere that faces inward is known again", "[hits]") {
  std::mt19937_64 random(79);
  Surface globe = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  globe.closed = false;
  for (std::size_t k = 0; k < globe.patches.size(); k += 2) globe.patches[k] = reversed(globe.patches[k]);
  const Surface other = box({2.0, 2.0, 2.0}, {3.0, 3.0, 3.0}, dmat3(1.0));
  const Tracer tracer({{globe, Solver::quadric}, {other, Solver::newton}});
  long inward = 0, ahead = 0, wrong = 0;
  for (int k = 0; k < 2000; ++k) {
    const dvec3 way = random_direction(random);
    const Hit wall = tracer.closest({3.0 * way, -way});
    REQUIRE(wall.surface == 0);
    inward += glm::dot(wall.normal, way) < 0.0;
    // The path came from this wall to one of the other surface, in the same place, and turns there.
    const dvec3 came = random_direction(random), goes = random_direction(random);
    if (std::fabs(glm::dot(came, way)) < 0.01 || std::fabs(glm::dot(goes, way)) < 0.01) continue;
    Hit here = wall;
    here.surface = 1, here.normal = random_direction(random), here.t = 0.0;
    PassedWalls passed;
    passed.arrive({wall.point, came, 0.0, INFINITY, {0, wall.normal}}, here);
    const bool is_ahead = glm::dot(came, way) * glm::dot(goes, way) < 0.0;
    const Hit next = tracer.closest({wall.point, goes, 0.0, INFINITY, {1, here.normal, &passed}});
    const bool met = next.surface == 0 && next.t < 1e-9;
    ahead += is_ahead, wrong += met != is_ahead;
  }
  INFO(inward << " walls face inward; of " << ahead << " ahead and the others behind, " << wrong
              << " are taken wrongly");
  CHECK(inward > 800);
  CHECK(ahead > 800);
  CHECK(wrong == 0);
}
