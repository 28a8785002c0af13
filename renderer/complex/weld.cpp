#include "renderer/complex/weld.h"

#include <algorithm>
#include <cmath>

#include "renderer/continuity/disjoint_sets.h"

namespace rondure {
namespace {

// Where the points of an edge are in a net's list, in the edge's order.
std::vector<std::size_t> edge_points(const Net& net, int edge) {
  std::vector<std::size_t> out;
  const auto add = [&](const auto& n, int i, int j) {
    out.push_back(static_cast<std::size_t>(&n.at(i, j) - points_of(net).data()));
  };
  if (const auto* t = std::get_if<TensorNet>(&net)) {
    const int last = edge % 2 == 0 ? t->m : t->n;
    for (int k = 0; k <= last; ++k) {
      const int s = edge < 2 ? k : last - k;
      edge % 2 == 0 ? add(*t, s, edge == 0 ? 0 : t->n) : add(*t, edge == 1 ? t->m : 0, s);
    }
    return out;
  }
  const auto& t = std::get<TriangleNet>(net);
  for (int k = 0; k <= t.n; ++k)
    edge == 0 ? add(t, t.n - k, k) : edge == 1 ? add(t, 0, t.n - k) : add(t, k, 0);
  return out;
}

}  // namespace

void weld(const SurfaceComplex& complex, std::vector<Net>& nets) {
  std::vector<std::size_t> begin;  // of each net's points among all
  std::vector<dvec4> points;
  for (const Net& net : nets) {
    begin.push_back(points.size());
    points.insert(points.end(), points_of(net).begin(), points_of(net).end());
  }
  double size = 0.0;
  for (const dvec4& p : points)
    size = std::max({size, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z), std::fabs(p.w)});
  DisjointSets groups(points.size());
  for (const EdgeJoin& join : complex.joins) {
    const auto a = static_cast<std::size_t>(join.p.polygon), b = static_cast<std::size_t>(join.q.polygon);
    std::vector<std::size_t> from = edge_points(nets[a], join.p.edge), to = edge_points(nets[b], join.q.edge);
    if (from.size() != to.size()) continue;
    for (std::size_t& k : from) k += begin[a];
    for (std::size_t& k : to) k += begin[b];
    // By points alone a short edge could be taken for its reverse.
    if (join.parameter.at(Exact(0)) != 0) std::reverse(to.begin(), to.end());
    bool same = true;
    for (std::size_t k = 0; k < from.size(); ++k) {
      const dvec4 d = points[from[k]] - points[to[k]];
      for (int c = 0; c < 4; ++c) same = same && std::fabs(d[c]) <= 0x1p-44 * size;
    }
    for (std::size_t k = 0; same && k < from.size(); ++k) groups.unite(from[k], to[k]);
  }
  for (std::size_t n = 0; n < nets.size(); ++n) {
    std::vector<dvec4>& net = points_of(nets[n]);
    for (std::size_t k = 0; k < net.size(); ++k) net[k] = points[groups.first(begin[n] + k)];
  }
}

}  // namespace rondure
