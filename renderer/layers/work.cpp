// What it took to find the hit.

#include "renderer/intersect/solve_leaf.h"
#include "renderer/layers/layers.h"

namespace rondure {
namespace {

enum Used { nothing = 0, closed_form = 1, newton = 2, clipping = 3, radial = 4, quadric = 5 };

Used solver_used(const World& world, const Hit& hit, std::size_t cells) {
  if (!hit) return nothing;
  const TracedSurface& traced = world.tracer().surfaces()[static_cast<std::size_t>(hit.surface)];
  if (traced.surface.ellipsoid) return closed_form;
  if (traced.solver == Solver::radial) return radial;
  if (traced.solver == Solver::quadric) return quadric;
  return cells > 0 || traced.solver == Solver::clipping ? clipping : newton;
}

void work(const World& world, const Ray& ray, const Hit& hit, double* values) {
  // Asked again, for the counts.
  const SolverCounts before = thread_counts();
  world.tracer().closest(ray);
  const SolverCounts& after = thread_counts();
  const std::size_t cells = after.search.cells - before.search.cells;
  values[0] = solver_used(world, hit, cells);
  values[1] = static_cast<double>(after.newton.leaves - before.newton.leaves);
  values[2] = static_cast<double>(after.newton.steps - before.newton.steps);
  values[3] = static_cast<double>(after.newton.undecided - before.newton.undecided);
  values[4] = static_cast<double>(cells);
}

}  // namespace

void register_work_layer(Registry& registry) {
  registry.add(LayerFactory{
      "work",
      "What the ray took: the hit's solver (0 none, 1 closed form, 2 newton, 3 clipping on some "
      "leaf, 4 radial, 5 quadric), leaves tested, Newton steps, leaves left to clipping, cells of clipping.",
      "Work",
      {"solver", "leaves", "steps", "undecided", "cells"},
      {},
      [](Params&) { return LayerFunction(work); }});
}

}  // namespace rondure
