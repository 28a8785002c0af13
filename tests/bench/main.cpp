// One run, one table: rays per second on one thread, as ratios to Embree's own sphere measured in the same
// rounds; Newton steps, memory and build times. Usage: rondure_bench [ROUNDS]

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>

#include "renderer/intersect/solve_leaf.h"
#include "renderer/intersect/tracer.h"
#include "tests/bench/embree_baselines.h"
#include "tests/bench/radial.h"
#include "tests/bench/ray_sets.h"
#include "tests/bench/scale.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;
using namespace rondure::bench;

namespace {

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Contender {
  std::string name;
  std::function<std::size_t(const std::vector<Ray>&)> trace;
  std::size_t bytes;
  double worst_error;
  std::vector<double> ratio[2] = {}, rate[2] = {};  // by ray set; to the first contender of the same round
};

Contender patch_contender(const std::string& name, const Tracer& tracer, const std::vector<Ray>& rays) {
  double worst = 0.0;
  for (const Ray& ray : rays)
    if (const Hit hit = tracer.closest(ray))
      worst = std::fmax(worst, std::fabs(glm::length(hit.point) - 1.0));
  const auto trace = [&tracer](const std::vector<Ray>& set) {
    std::size_t hits = 0;
    for (const Ray& ray : set) hits += static_cast<bool>(tracer.closest(ray));
    return hits;
  };
  return {name, trace, tracer.statistics().bytes, worst};
}

Contender baseline_contender(const std::string& name, const EmbreeBaseline& baseline,
                             const std::vector<Ray>& rays) {
  double worst = 0.0;
  baseline.trace(rays, &worst);
  return {name, [&baseline](const std::vector<Ray>& set) { return baseline.trace(set); }, baseline.bytes(),
          worst};
}

void print_counts(const char* name, const Tracer& tracer, const std::vector<Ray>& rays) {
  thread_counts() = {};
  for (const Ray& ray : rays) tracer.closest(ray);
  const SolverCounts& counts = thread_counts();
  const double n = static_cast<double>(rays.size());
  fmt::print(
      "  {:<24} {:>8.2f} {:>8.2f} {:>8.2f} {:>12.3f} {:>8.2f}\n", name,
      static_cast<double>(counts.newton.leaves) / n, static_cast<double>(counts.newton.steps) / n,
      static_cast<double>(counts.newton.steps) / std::max(1.0, static_cast<double>(counts.newton.iterated)),
      static_cast<double>(counts.newton.undecided) / n, static_cast<double>(counts.search.cells) / n);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 7;
  const std::vector<Ray> sets[2] = {coherent_rays(400), incoherent_rays(160'000)};
  const Surface cube = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  const Surface hemispheres = build_family(R"({"type": "sphere_tiling", "topology": "hemispheres"})");
  const Surface octants = build_family(R"({"type": "sphere_octant"})");
  const EmbreeBaseline point(EmbreeBaseline::Kind::sphere_point), user(EmbreeBaseline::Kind::user_sphere),
      mesh(EmbreeBaseline::Kind::triangle_mesh, 4'000'000);
  const Tracer analytic({{build_family(R"({"type": "sphere"})"), Solver::newton}});
  const Tracer cube_newton({{cube, Solver::newton}}), cube_clipping({{cube, Solver::clipping}});
  const Tracer hemispheres_newton({{hemispheres, Solver::newton}}),
      octants_newton({{octants, Solver::newton}});

  std::vector<Contender> contenders;
  contenders.push_back(baseline_contender("Embree SPHERE_POINT", point, sets[1]));
  contenders.push_back(baseline_contender("Embree user sphere", user, sets[1]));
  contenders.push_back(baseline_contender("Embree mesh, 4M", mesh, sets[1]));
  contenders.push_back(patch_contender("analytic sphere", analytic, sets[1]));
  contenders.push_back(patch_contender("cube, newton", cube_newton, sets[1]));
  contenders.push_back(patch_contender("hemispheres, newton", hemispheres_newton, sets[1]));
  contenders.push_back(patch_contender("octants, newton", octants_newton, sets[1]));
  contenders.push_back(patch_contender("cube, clipping", cube_clipping, sets[1]));

  std::size_t sink = 0;
  for (int round = 0; round < rounds; ++round)
    for (int set = 0; set < 2; ++set)
      for (Contender& c : contenders) {
        const double time = seconds([&] { sink += c.trace(sets[set]); });
        c.rate[set].push_back(static_cast<double>(sets[set].size()) / time * 1e-6);
        c.ratio[set].push_back(c.rate[set].back() / contenders[0].rate[set].back());
      }

  fmt::print("single rays, one thread, {} rounds ({} hits)\n", rounds, sink);
  fmt::print("  {:<24} {:>10} {:>10} {:>12} {:>12} {:>12} {:>12}\n", "", "coherent", "incoherent",
             "Mray/s coh.", "Mray/s inc.", "worst error", "memory");
  for (const Contender& c : contenders)
    fmt::print("  {:<24} {:>9.3f}x {:>9.3f}x {:>12.2f} {:>12.2f} {:>12.1e} {:>9.2f} MB\n", c.name,
               median(c.ratio[0]), median(c.ratio[1]), median(c.rate[0]), median(c.rate[1]), c.worst_error,
               static_cast<double>(c.bytes) * 1e-6);
  fmt::print("\nper incoherent ray           leaves    steps  steps/it.   undecided    cells\n");
  print_counts("cube, newton", cube_newton, sets[1]);
  print_counts("hemispheres, newton", hemispheres_newton, sets[1]);
  print_counts("octants, newton", octants_newton, sets[1]);
  print_counts("cube, clipping", cube_clipping, sets[1]);

  print_radial(rounds);

  print_scale(rounds);
  return 0;
}
