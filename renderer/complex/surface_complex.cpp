#include "renderer/complex/surface_complex.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/bezier/index.h"

namespace rondure {
namespace {

// Where a step leads: the corner, and the join, when the edge is glued.
struct Landing {
  Corner corner;
  int entered = 0;  // the edge through which it came
  FanStep step;
  bool glued = false;
};

class Walker {
 public:
  explicit Walker(const SurfaceComplex& complex) : complex_(complex), joined_(joins_by_edge(complex)) {}

  int sides(const Corner& c) const { return complex_.sides[index(c.polygon)]; }
  int before(const Corner& c) const { return (c.corner + sides(c) - 1) % sides(c); }
  // A corner lies between edge `corner` and the one before it.
  int other_edge(const Corner& c, int edge) const { return edge == c.corner ? before(c) : c.corner; }

  Landing cross(const Corner& from, int edge) const {
    const int join = joined_[index(from.polygon)][index(edge)];
    if (join < 0) return {};
    const EdgeJoin& j = complex_.joins[index(join)];
    const bool forwards = j.p == EdgeRef{from.polygon, edge};
    const EdgeRef to = forwards ? j.q : j.p;
    // A parameter takes ends to ends, so that its value at 0 tells all.
    const bool turned = j.parameter.at(Exact(0)) != 0;
    const bool at_start = from.corner == edge;
    const bool lands_at_start = at_start != turned;
    const int count = complex_.sides[index(to.polygon)];
    return {{to.polygon, lands_at_start ? to.edge : (to.edge + 1) % count}, to.edge, {join, forwards}, true};
  }

 private:
  const SurfaceComplex& complex_;
  std::vector<std::vector<int>> joined_;
};

VertexFan walk(const Walker& walker, const Corner& start) {
  VertexFan fan;
  Corner at = start;
  int leave = start.corner;
  // Back to where the fan begins, or once round.
  while (true) {
    const Landing to = walker.cross(at, leave);
    if (!to.glued) break;
    at = to.corner;
    leave = walker.other_edge(at, to.entered);
    if (at == start && leave == start.corner) {
      fan.closed = true;
      break;
    }
  }
  int onwards = fan.closed ? walker.before(start) : walker.other_edge(at, leave);
  if (fan.closed) at = start;
  const Corner first = at;
  const int first_onwards = onwards;
  while (true) {
    fan.corners.push_back(at);
    const Landing to = walker.cross(at, onwards);
    if (!to.glued) break;
    fan.steps.push_back(to.step);
    at = to.corner;
    onwards = walker.other_edge(at, to.entered);
    if (at == first && onwards == first_onwards) break;
  }
  return fan;
}

EdgeFunction along_factor(const EdgeFunction& parameter) { return derivative(parameter); }

}  // namespace

EdgeFunction edge_parameter(bool reversed) { return reversed ? linear(1, -1) : linear(0, 1); }

EdgeJoin join_by_image(EdgeRef p, EdgeRef q, const EdgeFunction& parameter, const EdgeField& image) {
  EdgeJoin join{p, q, parameter, {}};
  join.bundle[0][0] = along_factor(parameter);
  join.bundle[0][1] = image.along;
  join.bundle[1][1] = image.inward;
  return join;
}

// xi = a along + b inward, so that theta(inward) = -(eta + a mu' along) / b.
EdgeJoin join_by_fields(EdgeRef p, EdgeRef q, const EdgeFunction& parameter, const EdgeField& xi,
                        const EdgeField& eta) {
  const EdgeFunction minus_b = EdgeFunction(-1) * xi.inward;
  const EdgeFunction along = compose(eta.along, parameter) + xi.along * along_factor(parameter);
  return join_by_image(p, q, parameter, {along / minus_b, compose(eta.inward, parameter) / minus_b});
}

std::vector<std::vector<int>> joins_by_edge(const SurfaceComplex& complex) {
  std::vector<std::vector<int>> joined;
  for (const int sides : complex.sides) joined.emplace_back(index(sides), -1);
  for (std::size_t k = 0; k < complex.joins.size(); ++k) {
    for (const EdgeRef& e : {complex.joins[k].p, complex.joins[k].q})
      joined[index(e.polygon)][index(e.edge)] = static_cast<int>(k);
  }
  return joined;
}

std::vector<VertexFan> vertex_fans(const SurfaceComplex& complex) {
  const Walker walker(complex);
  std::vector<std::vector<bool>> seen;
  for (const int sides : complex.sides) seen.emplace_back(index(sides), false);
  std::vector<VertexFan> fans;
  for (int p = 0; p < static_cast<int>(complex.sides.size()); ++p) {
    for (int c = 0; c < complex.sides[index(p)]; ++c) {
      if (seen[index(p)][index(c)]) continue;
      fans.push_back(walk(walker, {p, c}));
      for (const Corner& corner : fans.back().corners)
        seen[index(corner.polygon)][index(corner.corner)] = true;
    }
  }
  return fans;
}

std::vector<std::vector<int>> fan_of_corner(const SurfaceComplex& complex,
                                            const std::vector<VertexFan>& fans) {
  std::vector<std::vector<int>> out;
  for (const int sides : complex.sides) out.emplace_back(index(sides), -1);
  for (std::size_t k = 0; k < fans.size(); ++k) {
    for (const Corner& c : fans[k].corners) out[index(c.polygon)][index(c.corner)] = static_cast<int>(k);
  }
  return out;
}

Topology topology_of(const SurfaceComplex& complex) {
  Topology t;
  t.polygons = static_cast<int>(complex.sides.size());
  t.vertices = static_cast<int>(vertex_fans(complex).size());
  for (const int sides : complex.sides) t.boundary_edges += sides;
  t.boundary_edges -= 2 * static_cast<int>(complex.joins.size());
  t.edges = t.boundary_edges + static_cast<int>(complex.joins.size());
  t.orientable = true;
  t.turned.assign(index(t.polygons), false);
  t.part.assign(index(t.polygons), 0);
  std::vector<bool> reached(index(t.polygons), false);
  for (int first = 0; first < t.polygons; ++first) {
    if (reached[index(first)]) continue;
    reached[index(first)] = true;
    t.part[index(first)] = t.parts;
    bool grew = true;
    while (grew) {
      grew = false;
      for (const EdgeJoin& join : complex.joins) {
        const std::size_t p = index(join.p.polygon), q = index(join.q.polygon);
        // Neighbours that run the same way along their common edge are turned round to each other.
        const bool differ = join.parameter.at(Exact(0)) == 0;
        if (reached[p] && reached[q]) {
          if (t.turned[q] != (t.turned[p] != differ)) t.orientable = false;
          continue;
        }
        if (!reached[p] && !reached[q]) continue;
        const std::size_t from = reached[p] ? p : q, to = reached[p] ? q : p;
        reached[to] = grew = true;
        t.turned[to] = t.turned[from] != differ;
        t.part[to] = t.parts;
      }
    }
    ++t.parts;
  }
  return t;
}

std::array<int, 2> corner_point(int sides, int corner) {
  constexpr std::array<std::array<int, 2>, 3> triangle{{{1, 0}, {0, 1}, {0, 0}}};
  constexpr std::array<std::array<int, 2>, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  return sides == 3 ? triangle[index(corner)] : square[index(corner)];
}

std::array<std::array<int, 2>, 2> edge_frame(int sides, int edge) {
  const auto here = corner_point(sides, edge);
  const auto next = corner_point(sides, (edge + 1) % sides);
  const auto before = corner_point(sides, (edge + sides - 1) % sides);
  return {{{next[0] - here[0], next[1] - here[1]}, {before[0] - here[0], before[1] - here[1]}}};
}

std::string name_of(const EdgeRef& edge) {
  return fmt::format("edge {} of polygon {}", edge.edge, edge.polygon);
}

}  // namespace rondure
