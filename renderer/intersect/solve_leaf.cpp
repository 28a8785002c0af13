#include "renderer/intersect/solve_leaf.h"

#include <algorithm>
#include <cmath>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/projected_net.h"
#include "renderer/intersect/settle.h"

namespace rondure {

SolverCounts& thread_counts() noexcept {
  static thread_local SolverCounts counts;
  return counts;
}

NewtonVerdict solve_by_newton(const Leaf& leaf, const Net& net, const NewtonPatch& patch, const LocalRay& ray,
                              NewtonRoot& found, SolverCounts& counts) noexcept {
  ++counts.newton.leaves;
  const NewtonVerdict verdict =
      patch.on_leaf(leaf, patch, ray, residual_bound(leaf.scale, ray), found, counts.newton);
  if (verdict == NewtonVerdict::undecided) ++counts.newton.undecided;
  if (verdict != NewtonVerdict::root) return verdict;
  Root& root = found.root;
  const dvec2 p(root.u, root.v);
  const double outside = patch.is_rectangle() ? TensorShape::outside(p) : TriangleShape::outside(p);
  if (outside <= 0.0) return verdict;
  if (!settle(net, leaf.scale, ray, root)) return NewtonVerdict::none;
  found.surface = net_first(net, root.u, root.v);
  return verdict;
}

namespace {

// A candidate's place on the ray, by how much rounding moves it there at most where the ray is tangential,
// and its residual.
struct Place {
  double s, doubt, residual;
};
Place place_of(const Leaf& leaf, const Net& net, const LocalRay& ray, const Root& root) {
  const FirstOrder<dvec4> at = net_first(net, root.u, root.v);
  if (!(at.value.w > 0.0)) return {INFINITY, 0.0, INFINITY};  // underflowed: no place in space
  const dvec3 point = dvec3(at.value) / at.value.w;
  const double error = settled_bound(leaf.scale, ray) / at.value.w, extent = leaf.scale.position / at.value.w;
  const dvec2 f = project(ray, at.value);
  return {glm::dot(point - ray.base, ray.direction) / ray.length2,
          2.0 * std::sqrt(2.0 * error * extent / ray.length2), std::max(std::fabs(f.x), std::fabs(f.y))};
}

// Settles the candidates. A ray that clings to a patch within rounding has thousands, all along the way: of
// those that cannot be told from one that has settled, for they touch no less than it does, none is asked;
// nor are more than some that cannot be told from one another, the nearest to the ray first.
void settle_all(const Leaf& leaf, const Net& net, const LocalRay& ray, std::vector<Root>& candidates,
                std::vector<Root>& roots) {
  constexpr std::size_t few = 8;
  constexpr int patience = 16;
  if (candidates.size() <= few) {
    for (Root root : candidates)
      if (settle(net, leaf.scale, ray, root)) roots.push_back(root);
    return;
  }
  struct Candidate {
    Root root;
    Place place;
  };
  static thread_local std::vector<Candidate> ordered;
  ordered.clear();
  for (const Root& root : candidates) ordered.push_back({root, place_of(leaf, net, ray, root)});
  std::stable_sort(ordered.begin(), ordered.end(), [](const Candidate& a, const Candidate& b) {
    return a.place.residual < b.place.residual;
  });
  struct Group {
    Place place;
    int refused;
  };
  static thread_local std::vector<Group> groups;
  groups.clear();
  for (Candidate& candidate : ordered) {
    Root& root = candidate.root;
    const Place& place = candidate.place;
    if (!root.tangent) {
      if (settle(net, leaf.scale, ray, root)) roots.push_back(root);
      continue;
    }
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
      return std::fabs(g.place.s - place.s) <= g.place.doubt;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), {place, 0});
    if (group->refused >= patience) continue;
    if (settle(net, leaf.scale, ray, root)) {
      roots.push_back(root);
      group->refused = patience;
    } else {
      ++group->refused;
    }
  }
}

}  // namespace

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
  settle_all(leaf, net, ray, candidates, roots);
}

}  // namespace rondure
