#include "renderer/intersect/direction_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/clipping.h"
#include "renderer/intersect/projected_net.h"
#include "renderer/intersect/settle.h"

namespace rondure {
namespace {

// Rounding is relative to the weights, and where these are small beside the greatest, so are the polynomials:
// the domain is halved until no part's weights differ by more than this, or the last of so many times.
constexpr double most_unequal = 4.0;
constexpr int most_halvings = 1 << 9;

template <class Shape>
void find_in_parts(const Shape& shape, const std::vector<dvec4>& points, const LocalRay& ray, double rounding,
                   std::vector<Root>& roots) {
  const std::size_t count = points.size();
  dvec2 projected[max_net_size], size[max_net_size], part[max_net_size], scratch[2][max_net_size];
  project_net(points, ray, projected);
  for (std::size_t k = 0; k < count; ++k) size[k] = dvec2(largest(dvec3(points[k])), points[k].w);
  SearchCounts counts;
  counts.limit = 1 << 12;
  int halvings = 0;
  for (std::vector<typename Shape::Cell> cells = {{}}; !cells.empty();) {
    const typename Shape::Cell cell = cells.back();
    cells.pop_back();
    shape.restrict_to(size, cell, part);
    NetScale scale;
    double least = INFINITY;
    for (std::size_t k = 0; k < count; ++k) {
      scale.position = std::max(scale.position, part[k].x);
      scale.weight = std::max(scale.weight, part[k].y);
      least = std::min(least, part[k].y);
    }
    if (scale.weight <= most_unequal * least || halvings == most_halvings) {
      find_roots(shape, projected, cell, rounding * residual_bound(scale, ray), roots, counts);
      continue;
    }
    typename Shape::Cell low, high;
    Shape::halve(cell, shape.steepest_edge(part, scratch[0], scratch[1]), low, high);
    cells.push_back(low), cells.push_back(high);
    ++halvings;
  }
}

}  // namespace

std::optional<dvec2> search_direction(const Net& net, const dvec3& n, double rounding) {
  LocalRay ray;  // through the centre
  if (!set_direction(n, ray)) return std::nullopt;
  set_normals(ray);
  set_distances(ray);
  std::vector<Root> roots;
  if (const auto* tensor = std::get_if<TensorNet>(&net))
    find_in_parts(TensorShape{tensor->m, tensor->n}, points_of(net), ray, rounding, roots);
  else
    find_in_parts(TriangleShape{std::get<TriangleNet>(net).n}, points_of(net), ray, rounding, roots);
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
