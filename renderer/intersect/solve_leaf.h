// One leaf, one ray: by Newton's method, and by `clipping` where that cannot decide.
#pragma once

#include "renderer/intersect/clipping.h"
#include "renderer/intersect/newton.h"
#include "renderer/intersect/tracer.h"

namespace rondure {

struct SolverCounts {
  NewtonCounts newton;
  SearchCounts search;
  std::size_t met_in_packets = 0;  // rays whose hits or misses were found in company
};

// The calling thread's counts, for benchmarks and tests.
SolverCounts& thread_counts() noexcept;

// Newton's method alone; a root is settled: on the patch, and on the ray.
NewtonVerdict solve_by_newton(const Leaf& leaf, const Net& net, const NewtonPatch& patch, const LocalRay& ray,
                              NewtonRoot& root, SolverCounts& counts) noexcept;

// Adds the roots of the ray on the leaf that `clipping` finds, settled, in no order.
void search_leaf(const Leaf& leaf, const Net& net, const LocalRay& ray, std::vector<Root>& roots,
                 SolverCounts& counts) noexcept;

}  // namespace rondure
