// Small surfaces that are very many: their leaves are met as clusters, and nothing is lost by that.

#include <fmt/core.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "renderer/intersect/leaf_cluster.h"
#include "renderer/intersect/solve_leaf.h"
#include "renderer/intersect/sphere_packets.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/mapped.h"
#include "tests/intersect/random_direction.h"
#include "tests/intersect/same_bits.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

namespace {

// Where the ray's line is in the box, in twice the precision that is asked for; empty where it is not.
std::pair<long double, long double> way_through(const Box& box, const LocalRay& ray) {
  long double enter = -INFINITY, leave = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const long double base = ray.base[k], d = ray.direction[k], low = box.low[k], high = box.high[k];
    if (d == 0.0L) {
      if (base < low || base > high) return {1.0L, -1.0L};
      continue;
    }
    const long double a = (low - base) / d, b = (high - base) / d;
    enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
  }
  return {enter, leave};
}

struct Solid {
  bool is_ball;
  dvec3 center;
  dmat3 axes;  // of a block, times half its sides
};

// Where the ray enters a solid that is scaled by so much, or infinity.
double entry(const Solid& solid, double scale, const Ray& ray) {
  const dvec3 from = ray.origin - solid.center;
  if (solid.is_ball) {
    const double b = -glm::dot(from, ray.direction), rest = scale * scale - glm::dot(from, from) + b * b;
    return rest > 0.0 && b > 0.0 ? b - std::sqrt(rest) : INFINITY;
  }
  double enter = 0.0, leave = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const dvec3 axis = solid.axes[k] / glm::dot(solid.axes[k], solid.axes[k]);
    const double place = glm::dot(from, axis), speed = glm::dot(ray.direction, axis);
    const double a = (-scale - place) / speed, b = (scale - place) / speed;
    enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : INFINITY;
}

// Six planar faces.
Surface block(const dmat3& axes) {
  Surface surface;
  for (int k = 0; k < 3; ++k)
    for (const double side : {-1.0, 1.0}) {
      TensorNet net(1, 1);
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
          net.at(i, j) = dvec4(side * axes[k] + (2.0 * i - 1.0) * axes[(k + 1) % 3] +
                                   side * (2.0 * j - 1.0) * axes[(k + 2) % 3],
                               1.0);
      surface.patches.push_back(net);
    }
  surface.closed = true;
  return surface;
}

struct Crowd {
  std::vector<Solid> solids;
  std::vector<TracedSurface> surfaces;
};

// Tilings of the unit sphere and blocks, each turned in its own way, on a grid.
Crowd crowd(int side, std::mt19937_64& random) {
  const Surface tiling = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  Crowd out;
  for (int k = 0; k < side * side * side; ++k) {
    const dvec3 center = 2.6 * dvec3(k % side, k / side % side, k / (side * side));
    const dmat4 turn = glm::rotate(dmat4(1.0), 0.1 * k, random_direction(random));
    const dmat3 axes = dmat3(turn) * dmat3(0.5, 0.0, 0.0, 0.0, 0.6, 0.0, 0.0, 0.0, 0.7);
    const bool is_ball = k % 4 != 0;
    Surface surface = is_ball ? mapped(tiling, turn) : block(axes);
    surface.origin = center;
    out.solids.push_back({is_ball, center, axes});
    out.surfaces.push_back({std::move(surface), Solver::newton});
  }
  return out;
}

}  // namespace

TEST_CASE("A cluster's leaves are those whose boxes a ray meets, the nearest first", "[solvers]") {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  long met_boxes = 0, lost = 0, strange = 0, unordered = 0, asked = 0, parted = 0;
  for (int round = 0; round < 3000; ++round) {
    const std::size_t count = 1 + static_cast<std::size_t>(round) % LeafCluster::most_leaves;
    const double size = std::exp2(20.0 * uniform(random)), away = round % 3 == 0 ? 1e4 * size : 0.0;
    std::vector<Box> boxes(count);
    const auto place = [&] {
      const double x = uniform(random), y = uniform(random), z = uniform(random);
      return dvec3(away, 0.0, -away) + size * dvec3(x, y, z);
    };
    for (Box& box : boxes) box.add(place()), box.add(0.7 * box.low + 0.3 * place());
    const LeafCluster cluster(boxes);
    dvec3 direction = round % 5 == 0 ? dvec3(round % 2, 0.0, 1 - round % 2) : random_direction(random);
    LocalRay ray;
    const dvec3 target = round % 2 ? place() : boxes[static_cast<std::size_t>(round) % count].center();
    if (!make_local_ray(target - 5.0 * size * direction, direction, dvec3(0.0), ray)) continue;
    // From anywhere about the cluster to anywhere behind.
    const double middle = glm::dot(dvec3(away, 0.0, -away) - ray.base, ray.direction) * ray.inverse_length2,
                 reach = 2.0 * size * std::sqrt(ray.inverse_length2), a = uniform(random),
                 b = uniform(random);
    const double from = middle + reach * std::min(a, b), to = middle + reach * std::max(a, b);
    LeafCluster::AllMet met;
    const std::size_t found = cluster.meet(ray, from, to, met);
    std::vector<bool> known(count, false);
    for (std::size_t k = 0; k < found; ++k) {
      known[met[k].leaf] = true;
      unordered += k > 0 && met[k].enter < met[k - 1].enter;
      // Wider by the cluster's own rounding to floats, a millionth, it has to be met.
      Box wide = boxes[met[k].leaf];
      wide.low -= dvec3(1e-5 * size), wide.high += dvec3(1e-5 * size);
      const auto [enter, leave] = way_through(wide, ray);
      strange += !(enter <= leave && leave >= from - 1e-5 * reach && enter <= to + 1e-5 * reach);
    }
    for (std::size_t k = 0; k < count; ++k, ++asked) {
      const auto [enter, leave] = way_through(boxes[k], ray);
      const bool meets = enter <= leave && leave >= from && enter <= to;
      met_boxes += meets, lost += meets && !known[k];
    }
    // All of them are visited where all are met.
    std::size_t visited = 0;
    cluster.visit([](const Box&) { return true; }, [&](unsigned) { ++visited; });
    parted += visited != count;
  }
  INFO(asked << " boxes, " << met_boxes << " met, " << lost << " lost, " << strange << " not met at all");
  CHECK(lost == 0);
  CHECK(strange == 0);
  CHECK(unordered == 0);
  CHECK(parted == 0);
  CHECK(met_boxes > 1000);
}

TEST_CASE("Very many small surfaces are met where they are, alone and in packets", "[hits][batch]") {
  constexpr int side = 23;  // so many that a tiling gets few enough leaves
  std::mt19937_64 random(22);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Crowd all = crowd(side, random);
  const Tracer tracer(all.surfaces);
  REQUIRE(tracer.statistics().clustered > 1 << 18);
  // Bundles of 16 from around, near and far, to somewhere at a solid.
  std::vector<Ray> rays;
  const dvec3 middle(1.3 * (side - 1));
  for (int bundle = 0; bundle < 100; ++bundle) {
    const Solid& solid = all.solids[static_cast<std::size_t>(uniform(random) * double(all.solids.size()))];
    const dvec3 origin =
        bundle % 2 ? solid.center + 1.8 * random_direction(random) : middle + 60.0 * random_direction(random);
    const double apart = std::exp2(-10.0 * uniform(random));
    for (int k = 0; k < 16; ++k) {
      const dvec3 target = solid.center + apart * random_direction(random);
      rays.push_back({origin, glm::normalize(target - origin)});
    }
  }
  long hits = 0, wrong = 0, grazing = 0, inside = 0;
  std::vector<Hit> alone;
  for (const Ray& ray : rays) {
    alone.push_back(tracer.closest(ray));
    const Hit& hit = alone.back();
    wrong += tracer.occluded(ray) != static_cast<bool>(hit);
    double first[2] = {INFINITY, INFINITY};
    bool starts_inside = false;
    for (const Solid& solid : all.solids) {
      for (const int k : {0, 1})
        first[k] = std::min(first[k], entry(solid, k ? 1.0 + 1e-9 : 1.0 - 1e-9, ray));
      starts_inside = starts_inside || (solid.is_ball && glm::distance(ray.origin, solid.center) < 1.0) ||
                      (!solid.is_ball && entry(solid, 1.0, ray) == 0.0);
    }
    hits += static_cast<bool>(hit);
    // Not those that an enlargement by a billionth changes, nor those that begin in a solid.
    if (starts_inside) {
      ++inside;
    } else if (std::isinf(first[0]) != std::isinf(first[1]) || std::fabs(first[0] - first[1]) > 1e-5) {
      ++grazing;
    } else if (std::isinf(first[0]) ? static_cast<bool>(hit) : !(std::fabs(hit.t - first[0]) < 1e-5)) {
      ++wrong;
    }
  }
  thread_counts() = {};
  const std::vector<std::string> sets = instruction_sets();
  for (const std::string& set : sets) {
    use_instruction_set(set);
    for (std::size_t first = 0; first < rays.size(); first += 16) {
      Hit together[16];
      tracer.closest(std::span(rays).subspan(first, 16), std::span(together));
      for (std::size_t k = 0; k < 16; ++k) wrong += !same_bits(together[k], alone[first + k]);
    }
  }
  use_instruction_set("");
  const std::size_t in_company = thread_counts().met_in_packets;
  INFO(rays.size() << " rays, " << hits << " hits, " << grazing << " graze, " << inside << " begin inside, "
                   << in_company << " in company, by " << sets.size() << " instruction sets");
  CHECK(wrong == 0);
  CHECK(hits > static_cast<long>(rays.size()) / 2);
  CHECK(grazing + inside < static_cast<long>(rays.size()) / 4);
  if (sets.size() > 2) CHECK(in_company > rays.size() / 10);
}
