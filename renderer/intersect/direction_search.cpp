#include "renderer/intersect/direction_search.h"

#include <algorithm>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/clipping.h"
#include "renderer/intersect/projected_net.h"
#include "renderer/intersect/settle.h"

namespace rondure {

std::optional<dvec2> search_direction(const Net& net, const dvec3& n) {
  LocalRay ray;  // through the centre
  if (!set_direction(n, ray)) return std::nullopt;
  set_normals(ray);
  set_distances(ray);
  NetScale scale;
  dvec2 projected[max_net_size];
  project_net(points_of(net), ray, projected);
  for (const dvec4& p : points_of(net)) {
    scale.position = std::max(scale.position, largest(dvec3(p)));
    scale.weight = std::max(scale.weight, p.w);
  }
  const double error = residual_bound(scale, ray);
  std::vector<Root> roots;
  SearchCounts counts;
  counts.limit = 1 << 12;
  if (const auto* tensor = std::get_if<TensorNet>(&net))
    find_roots(TensorShape{tensor->m, tensor->n}, projected, RectangleCell{}, error, roots, counts);
  else
    find_roots(TriangleShape{std::get<TriangleNet>(net).n}, projected, TriangleCell{}, error, roots, counts);
  std::optional<dvec2> best;
  double least = 1e-6;
  for (Root root : roots) {
    // The net is what it is: what is left of the root counts at the size of the point, not of the greatest
    // weights, beside which a small one would leave many roundoffs.
    const dvec4 at = net_first(net, root.u, root.v).value;
    settle(net, {largest(dvec3(at)), at.w}, ray, root);
    const double off = largest(net_point(net, root.u, root.v) - n);
    if (off < least) least = off, best = {root.u, root.v};
  }
  return best;
}

}  // namespace rondure
