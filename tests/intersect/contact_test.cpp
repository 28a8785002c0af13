// Surfaces that touch: a ray that has passed from one into the other meets neither wall again.

#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/boxes.h"
#include "tests/intersect/placed.h"
#include "tests/intersect/random_direction.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

namespace {

Surface ellipsoid(const dvec3& axes, const dvec3& center) {
  Surface out;
  out.ellipsoid = dmat3(axes.x, 0, 0, 0, axes.y, 0, 0, 0, axes.z);
  out.origin = center, out.closed = true;
  return out;
}

struct Touching {
  const char* name;
  std::vector<TracedSurface> surfaces;
  dvec3 at, across;    // the middle of the walls that they share, and their normal
  double wide;         // of these
  bool nested;         // the second within the first; or else all side by side
  bool floor = false;  // the second, a patch, is outside of the first
};

// A square patch, its normal up or down.
Surface square(const dmat3& turn, double side, double up) {
  Surface out;
  TensorNet net(1, 1);
  for (int i = 0; i <= 1; ++i)
    for (int j = 0; j <= 1; ++j)
      net.at(i, j) = dvec4(turn * (side * dvec3(j - 0.5, 0.0, up * (i - 0.5))), 1.0);
  out.patches.push_back(net);
  return out;
}

std::vector<Touching> touching() {
  std::vector<Touching> out;
  struct Corners {
    dvec3 low, high;
  };
  struct Boxes {
    const char* name;
    std::vector<Corners> boxes;
    bool nested = false;
  };
  const dvec3 all(1.0);
  for (const double angle : {0.0, 0.7})
    for (const Boxes& b :
         {Boxes{"two boxes", {{-all, {1.0, 0.0, 1.0}}, {{-1.0, 0.0, -1.0}, all}}},
          Boxes{"three", {{-all, {1, 0, 1}}, {{-1.0, 0.0, -1.0}, {1.0, 0.1, 1.0}}, {{-1.0, 0.1, -1.0}, all}}},
          Boxes{"one in the other", {{{-1.0, 0.0, -1.0}, all}, {{-1.0, 0.0, -1.0}, {1.0, 0.5, 1.0}}}, true},
          Boxes{"at a wall", {{{-1.0, 0.0, -1.0}, all}, {{-0.5, 0.0, -0.5}, {0.5, 0.5, 0.5}}}, true},
          Boxes{"the same", {{{-1.0, 0.0, -1.0}, all}, {{-1.0, 0.0, -1.0}, all}}, true}}) {
      const dmat3 turn = turn_about(glm::normalize(dvec3(3.0, -1.0, 2.0)), angle);
      Touching next{b.name, {}, dvec3(0.0), turn[1], 0.45, b.nested};
      for (const Corners& c : b.boxes) next.surfaces.push_back({box(c.low, c.high, turn), Solver::newton});
      out.push_back(next);
      next.name = "not said to be closed";
      for (TracedSurface& traced : next.surfaces) traced.surface.closed = false;
      out.push_back(next);
    }
  const dmat3 turn = turn_about(glm::normalize(dvec3(3.0, -1.0, 2.0)), 0.7);
  for (const double side : {1.0, 10.0})
    for (const double up : {-1.0, 1.0})
      out.push_back({"on a floor",
                     {{box({-1.0, 0.0, -1.0}, dvec3(1.0), turn), Solver::newton},
                      {square(turn, side, up), Solver::newton}},
                     dvec3(0.0),
                     turn[1],
                     0.45,
                     false,
                     true});
  for (const char* family : {R"({"type": "sphere_tiling", "topology": "cube"})", R"({"type": "sphere"})"})
    for (const Solver solver : {Solver::newton, Solver::quadric})
      for (const double other : {-0.4, 0.4, -1e-4, 1e-4}) {
        const Surface ball = build_family(family);
        const auto tangent = [&](double radius) {
          return TracedSurface{placed(ball, std::fabs(radius), radius * dvec3(2, 3, 6) / 7.0), solver};
        };
        out.push_back(
            {family, {tangent(1.0), tangent(other)}, dvec3(0.0), dvec3(2, 3, 6) / 7.0, 1e-7, other > 0.0});
      }
  return out;
}

}  // namespace

// Walls in one place: a ray goes through each once and in their order, as if there were a gap. It is never in
// two bodies that stand side by side, nor in the inner of two without the outer.
TEST_CASE("A wall that surfaces share is passed", "[hits]") {
  std::mt19937_64 random(41);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  std::vector<Touching> scenes = touching();
  // And away from the world's zero, where points are rounded more than surfaces are.
  for (const double away : {100.0, 1000.0})
    for (Touching scene : touching()) {
      const dvec3 frame = away * dvec3(-0.546, -0.839, -0.026);
      for (TracedSurface& traced : scene.surfaces) traced.surface.origin += frame;
      scene.at += frame;
      scenes.push_back(std::move(scene));
    }
  for (const Touching& scene : scenes) {
    const Tracer tracer(scene.surfaces);
    const std::size_t most = 2 * scene.surfaces.size();
    long walks = 0, hits = 0, floors = 0, stuck = 0, disordered = 0, shadows = 0;
    std::string first = "none";
    for (int k = 0; k < 2000; ++k) {
      dvec3 aside = scene.wide * part(random) * random_direction(random);
      aside -= glm::dot(aside, scene.across) * scene.across;
      dvec3 direction = random_direction(random);
      if (k % 4 == 0) direction = (k % 8 == 0 ? 1.0 : -1.0) * scene.across;
      if (std::fabs(glm::dot(direction, scene.across)) < 1e-2) continue;
      Ray ray{scene.at + aside - 5.0 * direction, direction};
      std::vector<int> in(scene.surfaces.size());
      std::string path;
      bool disorder = false;
      std::size_t met = 0;
      for (; met <= most; ++met) {
        const Hit hit = tracer.closest(ray);
        shadows += tracer.occluded(ray) != static_cast<bool>(hit);
        if (!hit) break;
        const bool out = glm::dot(hit.normal, direction) > 0.0;
        path += fmt::format(" {}{} at {}", out ? "out of " : "into ", hit.surface, hit.t);
        ray = Ray{hit.point, direction, 0.0, INFINITY, {hit.surface, hit.normal}};
        if (scene.floor && hit.surface == 1) {
          disorder = disorder || in[0] != 0;
          ++floors;
          continue;
        }
        int& inside = in[static_cast<std::size_t>(hit.surface)];
        inside += out ? -1 : 1;
        const auto bodies = std::count(in.begin(), in.end(), 1);
        disorder = disorder || inside < 0 || inside > 1 || (scene.nested ? in[1] > in[0] : bodies > 1);
      }
      disorder = disorder || std::count(in.begin(), in.end(), 0) != std::ssize(in);
      ++walks, hits += static_cast<long>(met);
      if (disorder && disordered++ == 0) first = path;
      stuck += met > most;
    }
    INFO(scene.name << ": of " << walks << " walks, " << hits << " hits, " << stuck << " end nowhere, "
                    << disordered << " out of order, the first" << first);
    CHECK(stuck == 0);
    CHECK(disordered == 0);
    CHECK(shadows == 0);
    CHECK(hits > 2 * walks);
    CHECK(floors == (scene.floor ? walks : 0));
  }
}

// What touches within is what bends more, whatever is larger. From the outer one inward the inner is met at
// once, from the inner one outward the outer; and no other way.
TEST_CASE("Where ellipsoids touch, the one that bends more is within", "[hits]") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  struct Second {
    dvec3 axes, center;
    bool within;  // the unit sphere, at (0, 0, 1)
  };
  for (const Second& second : {Second{dvec3(0.5), dvec3(0.0, 0.0, 0.5), true},
                               {dvec3(1.5, 1.5, 5.0), dvec3(0.0, 0.0, -4.0), true},
                               {dvec3(0.9, 0.9, 0.2), dvec3(0.0, 0.0, 0.8), false}}) {
    const Tracer tracer({{ellipsoid(dvec3(1.0), dvec3(0.0)), Solver::newton},
                         {ellipsoid(second.axes, second.center), Solver::newton}});
    long due = 0, lost = 0, others = 0, wrong = 0;
    for (int k = 0; k < 10'000; ++k) {
      const int from = k % 2;
      const dvec3 axes = from == 0 ? dvec3(1.0) : second.axes,
                  center = from == 0 ? dvec3(0.0) : second.center;
      const dvec3 beside = std::pow(10.0, -10.0 - 7.0 * part(random)) * random_direction(random),
                  up = glm::normalize(dvec3(0.0, 0.0, 1.0) + beside),
                  start = center + glm::normalize(up * axes) * axes,
                  normal = glm::normalize((start - center) / (axes * axes));
      const dvec3 direction = random_direction(random);
      const double rise = glm::dot(direction, normal);
      if (std::fabs(rise) < 1e-2) continue;
      const Hit hit = tracer.closest({start, direction, 0.0, INFINITY, {from, normal}});
      // Walls and start are within some ulps of 5, over the rise.
      const bool at_once = hit && hit.surface != from && hit.t < 16.0 * 5.0 * 0x1p-52 / std::fabs(rise);
      const bool starts_within = (from == 1) == second.within;
      if (starts_within == (rise > 0.0))
        ++due, lost += !at_once;
      else
        ++others, wrong += at_once;
    }
    INFO("semi-axes " << second.axes.x << ", " << second.axes.z << ": of " << due << " hits " << lost
                      << " are lost; " << wrong << " of " << others << " others are met");
    CHECK(lost == 0);
    CHECK(wrong == 0);
    CHECK(due > 4000);
    CHECK(others > 4000);
  }
}
