#include "renderer/study/ray_trials.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/intersect/solve_leaf.h"
#include "renderer/sampling/warps.h"

namespace rondure {
namespace {

constexpr double meant = 1e-6;  // of the extent: a hit no further away is the one that was aimed at

void add_ray(const Tracer& tracer, const Ray& ray, const dvec3& target, double extent, RayTrial& trial) {
  const SolverCounts before = thread_counts();
  // Any of the hits: on a surface that is not convex the place may lie behind another.
  double nearest = std::numeric_limits<double>::infinity();
  for (const Hit& hit : tracer.all(ray)) nearest = std::min(nearest, glm::distance(hit.point, target));
  const SolverCounts& after = thread_counts();
  if (nearest <= meant * extent) {
    ++trial.hits;
    trial.off = std::max(trial.off, nearest / extent);
  }
  trial.steps += static_cast<long>(after.newton.steps - before.newton.steps);
  trial.undecided += static_cast<long>(after.newton.undecided - before.newton.undecided);
  trial.cells += static_cast<long>(after.search.cells - before.search.cells);
}

}  // namespace

RayTrials::RayTrials(const TracedSurface& traced) : origin_(traced.surface.origin) {
  for (const Solver solver : {traced.solver, Solver::newton, Solver::clipping})
    tracers_.emplace_back(std::vector{TracedSurface{traced.surface, solver}});
}

std::array<RayTrial, RayTrials::solver_count> RayTrials::at(const dvec3& point, const dvec3& normal) const {
  const dvec3 target = origin_ + point, aside = frame_about(normal).y;
  std::array<RayTrial, solver_count> trials;
  for (std::size_t k = 0; k < solver_count; ++k) {
    const double extent = tracers_[k].bounding_radius();
    for (const dvec3& from : {normal, 0.5 * normal + std::sqrt(0.75) * aside})
      add_ray(tracers_[k], Ray{target + 3.0 * extent * from, -from}, target, extent, trials[k]);
  }
  return trials;
}

}  // namespace rondure
