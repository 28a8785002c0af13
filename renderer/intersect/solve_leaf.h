// One leaf, one ray, by the solver that the scene chose.
#pragma once

#include "renderer/intersect/clipping.h"
#include "renderer/intersect/newton.h"
#include "renderer/intersect/tracer.h"

namespace rondure {

struct SolverCounts {
  NewtonCounts newton;
  SearchCounts search;
};

// The calling thread's counts, for benchmarks and tests.
SolverCounts& thread_counts() noexcept;

// Roots of the ray on the leaf, settled. `newton` hands leaves that it cannot decide to `clipping`.
void solve_leaf(Solver solver, const Leaf& leaf, const Net& net, const LocalRay& ray, RootList& roots,
                SolverCounts& counts) noexcept;

}  // namespace rondure
