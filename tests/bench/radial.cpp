#include "tests/bench/radial.h"

#include <fmt/core.h>

#include <algorithm>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/tracer.h"
#include "tests/bench/ray_sets.h"
#include "tests/bench/stopwatch.h"
#include "tests/surfaces/build_family.h"

namespace rondure::bench {
namespace {

// To about the size of the unit sphere, at which the rays are aimed.
Surface at_unit_size(Surface surface) {
  double size = 0.0;
  for (const Net& net : surface.patches)
    for (const double u : {0.0, 0.3, 1.0})
      for (const double v : {0.0, 0.3}) size = std::max(size, glm::length(net_point(net, u * (1.0 - v), v)));
  for (Net& net : surface.patches)
    for (dvec4& p : points_of(net)) p.w *= size;
  return surface;
}

double nanoseconds(const Tracer& tracer, const std::vector<Ray>& rays, std::size_t& hits) {
  const double time = seconds([&] {
    for (const Ray& ray : rays) hits += static_cast<bool>(tracer.closest(ray));
  });
  return 1e9 * time / static_cast<double>(rays.size());
}

}  // namespace

void print_radial(int rounds) {
  const std::pair<const char*, const char*> models[] = {
      {"creased octahedron, n = 2",
       R"({"type": "iss", "degree": 2, "vertices": [[1,0,0],[-1,0,0],[0,1,0],[0,-1,0],[0,0,1],[0,0,-1]],
          "patches": [{"triangle": [0,2,4]}, {"triangle": [1,2,4]}, {"triangle": [0,3,4]}, {"triangle": [1,3,4]},
                      {"triangle": [0,2,5]}, {"triangle": [1,2,5]}, {"triangle": [0,3,5]}, {"triangle": [1,3,5]}]})"},
      {"pebble, n = 3", R"({"type": "iss", "octants": {"degree": 3, "interior": 1}})"},
      {"pear, n = 4",
       R"({"type": "iss", "octants": {"degree": 4, "interior": [{"112": 0.4, "rest": 0.6}, 0.6, 0.6,
          0.6, {"112": 1.4, "rest": 1.1}, 1.1, 1.1, 1.1]}})"},
      {"raspberry, n = 6", R"({"type": "iss", "octants": {"degree": 6,
          "interior": {"411": 0.7, "141": 0.7, "114": 0.7, "222": 0.12, "rest": 0.35}}})"},
      {"n = 9", R"({"type": "iss", "octants": {"degree": 9, "interior": 1}})"}};
  const std::vector<Ray> sets[2] = {coherent_rays(120), incoherent_rays(15'000)};
  fmt::print(
      "\ninverse spherical surfaces       ns a ray, coherent          ns a ray, incoherent           "
      "memory\n");
  fmt::print("  {:<26} {:>8} {:>8} {:>7}   {:>8} {:>8} {:>7}   {:>7} {:>7} MB\n", "", "newton", "radial",
             "ratio", "newton", "radial", "ratio", "newton", "radial");
  std::size_t hits[2] = {};
  for (const auto& [name, object] : models) {
    const Surface surface = at_unit_size(build_family(object));
    const Tracer tracers[2] = {Tracer({{surface, Solver::newton}}), Tracer({{surface, Solver::radial}})};
    std::vector<double> time[2][2], ratio[2];
    for (int round = 0; round < rounds; ++round) {
      for (int set = 0; set < 2; ++set) {
        for (int k = 0; k < 2; ++k) time[set][k].push_back(nanoseconds(tracers[k], sets[set], hits[k]));
        ratio[set].push_back(time[set][0].back() / time[set][1].back());
      }
    }
    fmt::print("  {:<26}", name);
    for (int set = 0; set < 2; ++set)
      fmt::print(" {:>8.0f} {:>8.0f} {:>6.2f}x  ", median(time[set][0]), median(time[set][1]),
                 median(ratio[set]));
    fmt::print(" {:>7.2f} {:>7.2f}\n", static_cast<double>(tracers[0].statistics().bytes) * 1e-6,
               static_cast<double>(tracers[1].statistics().bytes) * 1e-6);
  }
  fmt::print("  hits: {} and {}\n", hits[0], hits[1]);
}

}  // namespace rondure::bench
