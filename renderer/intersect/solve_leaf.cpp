#include "renderer/intersect/solve_leaf.h"

#include "renderer/intersect/projected_net.h"
#include "renderer/intersect/settle.h"

namespace rondure {

SolverCounts& thread_counts() noexcept {
  static thread_local SolverCounts counts;
  return counts;
}

void solve_leaf(Solver solver, const Leaf& leaf, const Net& net, const LocalRay& ray,
                std::vector<Root>& roots, SolverCounts& counts) noexcept {
  const double error = residual_bound(leaf.scale, ray);
  if (solver != Solver::clipping) {
    Root root;
    switch (newton_on_leaf(leaf, net, ray, error, root, counts.newton)) {
      case NewtonVerdict::none:
        return;
      case NewtonVerdict::root:
        if (settle(net, leaf.scale, ray, root)) roots.push_back(root);
        return;
      case NewtonVerdict::undecided:
        break;
    }
  }
  dvec2 projected[max_net_size];
  project_net(points_of(net), ray, projected);
  // Kept by the thread, so that nothing is allocated once it is warm.
  static thread_local std::vector<Root> candidates;
  candidates.clear();
  if (const auto* tensor = std::get_if<TensorNet>(&net))
    find_roots(TensorShape{tensor->m, tensor->n}, projected, rectangle_of(leaf), error, candidates,
               counts.search);
  else
    find_roots(TriangleShape{std::get<TriangleNet>(net).n}, projected, triangle_of(leaf), error, candidates,
               counts.search);
  for (Root root : candidates)
    if (settle(net, leaf.scale, ray, root)) roots.push_back(root);
}

}  // namespace rondure
