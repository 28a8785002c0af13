#include "renderer/intersect/solve_leaf.h"

#include "renderer/bezier/rational.h"
#include "renderer/intersect/projected_net.h"
#include "renderer/intersect/settle.h"

namespace rondure {

SolverCounts& thread_counts() noexcept {
  static thread_local SolverCounts counts;
  return counts;
}

NewtonVerdict solve_by_newton(const Leaf& leaf, const Net& net, const LocalRay& ray, NewtonRoot& found,
                              SolverCounts& counts) noexcept {
  const NewtonVerdict verdict =
      newton_on_leaf(leaf, net, ray, residual_bound(leaf.scale, ray), found, counts.newton);
  if (verdict != NewtonVerdict::root) return verdict;
  Root& root = found.root;
  const dvec2 p(root.u, root.v);
  const bool inside =
      (std::holds_alternative<TensorNet>(net) ? TensorShape::outside(p) : TriangleShape::outside(p)) <= 0.0;
  if (inside) return verdict;
  if (!settle(net, leaf.scale, ray, root)) return NewtonVerdict::none;
  found.surface = net_first(net, root.u, root.v);
  return verdict;
}

void search_leaf(const Leaf& leaf, const Net& net, const LocalRay& ray, std::vector<Root>& roots,
                 SolverCounts& counts) noexcept {
  const double error = residual_bound(leaf.scale, ray);
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

void solve_leaf(Solver solver, const Leaf& leaf, const Net& net, const LocalRay& ray,
                std::vector<Root>& roots, SolverCounts& counts) noexcept {
  if (solver != Solver::clipping) {
    NewtonRoot found;
    const NewtonVerdict verdict = solve_by_newton(leaf, net, ray, found, counts);
    if (verdict == NewtonVerdict::root) roots.push_back(found.root);
    if (verdict != NewtonVerdict::undecided) return;
  }
  search_leaf(leaf, net, ray, roots, counts);
}

}  // namespace rondure
