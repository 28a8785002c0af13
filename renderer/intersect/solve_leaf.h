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

// Adds the roots of the ray on the leaf, settled, in no order. `newton` hands leaves that it cannot decide to
// `clipping`.
void solve_leaf(Solver solver, const Leaf& leaf, const Net& net, const LocalRay& ray,
                std::vector<Root>& roots, SolverCounts& counts) noexcept;

}  // namespace rondure
