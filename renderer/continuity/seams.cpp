#include "renderer/continuity/seams.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>

#include "renderer/bezier/box.h"
#include "renderer/bezier/index.h"
#include "renderer/continuity/disjoint_sets.h"
#include "renderer/continuity/side_foot.h"

namespace rondure {
namespace {

dvec2 corner_at(bool triangle, int corner) {
  static constexpr double of_triangle[3][2] = {{1, 0}, {0, 1}, {0, 0}};
  static constexpr double of_square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const double* p = triangle ? of_triangle[corner % 3] : of_square[corner % 4];
  return {p[0], p[1]};
}

// A side with points of it, at equal steps of its parameter.
struct Curve {
  static constexpr int steps = 8;
  PatchSide where;
  const Net* net = nullptr;
  dvec3 points[steps + 1];
  int from = 0, to = 0;  // vertices
  bool used = false;
};

// `searches` counts down the nearest points that may still be looked for.
bool same_curve(const Curve& a, const Curve& b, bool reversed, double tolerance, long& searches) {
  for (int k = 0; k <= Curve::steps; ++k) {
    const int other = reversed ? Curve::steps - k : k;
    if (glm::distance(a.points[k], b.points[other]) <= tolerance) continue;
    const double guess = static_cast<double>(other) / Curve::steps;
    if (k == 0 || k == Curve::steps || --searches < 0) return false;
    if (!(foot_on_side(*b.net, b.where.side, a.points[k], guess).distance <= tolerance)) return false;
  }
  return true;
}

// Numbers for points, the same for points closer than the tolerance.
std::vector<int> clustered(const std::vector<dvec3>& points, double tolerance) {
  // A direction with nothing in common with the vertices of any model, to sort by.
  const dvec3 along(0.53770812, 0.30195523, 0.78723041);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> key;
  for (const dvec3& p : points) key.push_back(glm::dot(p, along));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key[a] < key[b]; });
  std::vector<int> number(points.size(), -1);
  int count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t p = order[i];
    for (std::size_t j = i; j-- > 0 && key[p] - key[order[j]] <= tolerance && number[p] < 0;) {
      if (glm::distance(points[p], points[order[j]]) <= tolerance) number[p] = number[order[j]];
    }
    if (number[p] < 0) number[p] = count++;
  }
  return number;
}

std::vector<Curve> curves_of(const std::vector<Net>& patches, double& size) {
  std::vector<Curve> curves;
  Box box;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    for (int side = 0; side < side_count(patches[k]); ++side) {
      Curve c;
      c.where = {static_cast<int>(k), side};
      c.net = &patches[k];
      for (int step = 0; step <= Curve::steps; ++step) {
        c.points[step] = point_on_side(patches[k], side, static_cast<double>(step) / Curve::steps);
        box.add(c.points[step]);
      }
      curves.push_back(c);
    }
  }
  size = box.empty() ? 0.0 : glm::length(box.high - box.low);
  return curves;
}

void orient(const std::vector<Net>& patches, Seams& out) {
  out.turned.assign(patches.size(), false);
  std::vector<std::vector<std::pair<std::size_t, bool>>> next(patches.size());
  for (const Seam& seam : out.seams) {
    next[index(seam.a.patch)].emplace_back(index(seam.b.patch), !seam.reversed);
    next[index(seam.b.patch)].emplace_back(index(seam.a.patch), !seam.reversed);
  }
  std::vector<bool> reached(patches.size(), false);
  for (std::size_t first = 0; first < patches.size(); ++first) {
    if (reached[first]) continue;
    reached[first] = true;
    std::vector<std::size_t> front{first};
    while (!front.empty()) {
      const std::size_t p = front.back();
      front.pop_back();
      for (const auto& [q, differ] : next[p]) {
        if (reached[q]) {
          if (out.turned[q] != (out.turned[p] != differ)) out.orientable = false;
          continue;
        }
        reached[q] = true;
        out.turned[q] = out.turned[p] != differ;
        front.push_back(q);
      }
    }
  }
}

}  // namespace

int side_count(const Net& net) { return std::holds_alternative<TriangleNet>(net) ? 3 : 4; }

dvec2 side_point(const Net& net, int side, double t) {
  const bool triangle = std::holds_alternative<TriangleNet>(net);
  return (1.0 - t) * corner_at(triangle, side) + t * corner_at(triangle, side + 1);
}

namespace {

// Corners that the joins glue, by their curve; sides that are a point glue theirs too.
std::vector<int> glued(const std::vector<Curve>& curves, const std::vector<SideJoin>& joins,
                       const std::vector<std::size_t>& first, const std::vector<bool>& collapsed) {
  const auto end = [&](std::size_t k) {
    const Curve& c = curves[k];
    return first[index(c.where.patch)] + index((c.where.side + 1) % side_count(*c.net));
  };
  DisjointSets vertices(curves.size());
  for (const SideJoin& j : joins) {
    const std::size_t a = first[index(j.patch)] + index(j.side),
                      b = first[index(j.other)] + index(j.other_side);
    vertices.unite(a, j.reversed ? end(b) : b);
    vertices.unite(end(a), j.reversed ? b : end(b));
  }
  for (std::size_t k = 0; k < curves.size(); ++k) {
    if (collapsed[k]) vertices.unite(k, end(k));
  }
  return vertices.numbers();
}

// Pairs of sides that are one curve.
void match(std::vector<Curve>& curves, double tolerance, Seams& out) {
  // Different curves between the same two points are told apart by one search each; some 10 microseconds.
  long searches = 100000;
  std::map<std::pair<int, int>, std::vector<std::size_t>> by_ends;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    if (!curves[k].used) by_ends[std::minmax(curves[k].from, curves[k].to)].push_back(k);
  }
  for (const auto& entry : by_ends) {
    const std::vector<std::size_t>& list = entry.second;
    for (std::size_t i = 0; i < list.size(); ++i) {
      Curve& a = curves[list[i]];
      for (std::size_t j = i + 1; j < list.size() && !a.used; ++j) {
        Curve& b = curves[list[j]];
        if (b.used) continue;
        const bool reversed = a.from == b.to && same_curve(a, b, true, tolerance, searches);
        if (!reversed && !(a.from == b.from && same_curve(a, b, false, tolerance, searches))) continue;
        out.seams.push_back({a.where, b.where, reversed});
        a.used = b.used = true;
      }
    }
  }
  out.complete = searches >= 0;
}

}  // namespace

Seams find_seams(const std::vector<Net>& patches, const std::vector<SideJoin>& joins) {
  Seams out;
  double size = 0.0;
  std::vector<Curve> curves = curves_of(patches, size);
  const double tolerance = 0x1p-30 * size;
  std::vector<std::size_t> first(patches.size(), 0);  // curve of each patch
  std::vector<bool> collapsed;
  std::vector<dvec3> starts;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    Curve& c = curves[k];
    if (c.where.side == 0) first[index(c.where.patch)] = k;
    starts.push_back(c.points[0]);
    collapsed.push_back(std::all_of(std::begin(c.points), std::end(c.points), [&](const dvec3& p) {
      return glm::distance(p, c.points[0]) <= tolerance;
    }));
    if (!collapsed.back()) continue;
    out.collapsed.push_back(c.where);
    c.used = true;
  }
  const std::vector<int> vertex =
      joins.empty() ? clustered(starts, tolerance) : glued(curves, joins, first, collapsed);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    Curve& c = curves[k];
    c.from = vertex[k];
    c.to = vertex[first[index(c.where.patch)] + index((c.where.side + 1) % side_count(*c.net))];
  }
  for (const SideJoin& j : joins) {
    Curve &a = curves[first[index(j.patch)] + index(j.side)],
          &b = curves[first[index(j.other)] + index(j.other_side)];
    if (a.used || b.used) continue;
    out.seams.push_back({a.where, b.where, j.reversed});
    a.used = b.used = true;
  }
  if (joins.empty()) match(curves, tolerance, out);
  const int vertices = vertex.empty() ? 0 : *std::max_element(vertex.begin(), vertex.end()) + 1;
  out.vertices.resize(index(vertices));
  for (SeamVertex& v : out.vertices) v.closed = true;
  for (const Curve& c : curves) {
    out.vertices[index(c.from)].corners.push_back(c.where);
    if (c.used) continue;
    out.open.push_back(c.where);
    out.vertices[index(c.from)].closed = out.vertices[index(c.to)].closed = false;
  }
  orient(patches, out);
  return out;
}

}  // namespace rondure
