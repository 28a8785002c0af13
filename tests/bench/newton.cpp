#include "tests/bench/newton.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "renderer/intersect/solve_leaf.h"
#include "renderer/intersect/tracer.h"
#include "tests/bench/embree_baselines.h"
#include "tests/bench/ray_sets.h"
#include "tests/surfaces/build_family.h"

namespace rondure::bench {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// A cushion about the origin that is on no quadric: two sheets of 3 x 3 bicubic patches each, polynomial or,
// with the weights of their rims, rational.
Surface cushion(bool rational) {
  constexpr int patches = 3;
  Surface surface;
  const auto height = [](double x, double y) {
    return 0.75 * (1.0 - x * x) * (1.0 - y * y) +
           0.12 * std::sin(3.0 * x) * std::cos(2.0 * y) * (1.0 - x * x);
  };
  for (const double side : {1.0, -1.0})
    for (int a = 0; a < patches; ++a)
      for (int b = 0; b < patches; ++b) {
        TensorNet net(3, 3);
        for (int i = 0; i <= 3; ++i)
          for (int j = 0; j <= 3; ++j) {
            const double x = side * (2.0 * (a + i / 3.0) / patches - 1.0),
                         y = 2.0 * (b + j / 3.0) / patches - 1.0;
            const bool inner = i % 3 != 0 && j % 3 != 0;
            const double w = rational && inner ? 1.5 : 1.0;
            net.at(i, j) = w * dvec4(0.9 * x, 0.9 * y, side * height(x, y), 1.0);
          }
        surface.patches.push_back(net);
      }
  return surface;
}

struct Contender {
  const char* name;
  Tracer tracer;
  std::vector<double> ratio[2] = {};
};

double seconds_of(const std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;  // this thread's own: others may be busy
}

}  // namespace

void print_newton(int rounds) {
  const auto traced = [](Surface surface) { return Tracer({{std::move(surface), Solver::newton}}); };
  std::vector<Contender> contenders;
  contenders.push_back(
      {"cube, (4, 4)", traced(build_family(R"({"type": "sphere_tiling", "topology": "cube"})"))});
  contenders.push_back({"hemispheres, (2, 4)",
                        traced(build_family(R"({"type": "sphere_tiling", "topology": "hemispheres"})"))});
  contenders.push_back({"octants, triangles, 4", traced(build_family(R"({"type": "sphere_octant"})"))});
  contenders.push_back({"cushion, (3, 3)", traced(cushion(false))});
  contenders.push_back({"cushion, rational", traced(cushion(true))});
  const EmbreeBaseline point(EmbreeBaseline::Kind::sphere_point);
  const std::vector<Ray> sets[2] = {coherent_rays(200), incoherent_rays(40'000)};
  std::size_t sink = 0;
  for (int round = 0; round < rounds; ++round)
    for (int set = 0; set < 2; ++set) {
      const std::clock_t start = std::clock();
      sink += point.trace(sets[set]);
      const double reference = seconds_of(start);
      for (Contender& c : contenders) {
        const std::clock_t begin = std::clock();
        for (const Ray& ray : sets[set]) sink += static_cast<bool>(c.tracer.closest(ray));
        c.ratio[set].push_back(reference / seconds_of(begin));
      }
    }
  fmt::print("\nnewton, single rays, beside Embree's sphere ({} hits)\n", sink);
  fmt::print("  {:<22} {:>9} {:>10} {:>7} {:>8} | per incoherent ray: {:>7} {:>7} {:>10} {:>6}\n", "",
             "coherent", "incoherent", "leaves", "memory", "leaves", "steps", "searches", "hits");
  for (const Contender& c : contenders) {
    thread_counts() = {};
    std::size_t hits = 0;
    for (const Ray& ray : sets[1]) hits += static_cast<bool>(c.tracer.closest(ray));
    const NewtonCounts& counts = thread_counts().newton;
    const double n = static_cast<double>(sets[1].size());
    fmt::print("  {:<22} {:>8.3f}x {:>9.3f}x {:>7} {:>5.2f} MB | {:>27.2f} {:>7.2f} {:>10.4f} {:>6.2f}\n",
               c.name, median(c.ratio[0]), median(c.ratio[1]), c.tracer.statistics().leaves,
               static_cast<double>(c.tracer.statistics().bytes) * 1e-6,
               static_cast<double>(counts.leaves) / n, static_cast<double>(counts.steps) / n,
               static_cast<double>(counts.undecided) / n, static_cast<double>(hits) / n);
  }
}

}  // namespace rondure::bench
