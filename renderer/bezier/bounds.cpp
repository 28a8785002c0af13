#include "renderer/bezier/bounds.h"

#include <algorithm>
#include <cmath>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/tensor.h"
#include "renderer/bezier/triangle.h"

namespace rondure {
namespace {

struct Search {
  Box box;
  int pieces = 0;
};

void add_hull(const std::vector<dvec4>& points, Box& box) {
  for (const dvec4& h : points) {
    const dvec3 p = dvec3(h) / h.w;
    for (int c = 0; c < 3; ++c) {
      // The quotient is rounded to nearest: its neighbours enclose the true one.
      box.low[c] = std::min(box.low[c], std::nextafter(p[c], -infinity));
      box.high[c] = std::max(box.high[c], std::nextafter(p[c], infinity));
    }
  }
}

bool one_sign(const std::vector<dvec4>& points) {
  const auto positive = [](const dvec4& p) { return p.w > 0.0; };
  const auto negative = [](const dvec4& p) { return p.w < 0.0; };
  return std::all_of(points.begin(), points.end(), positive) ||
         std::all_of(points.begin(), points.end(), negative);
}

bool add(const TensorNet& net, int depth, Search& search);
bool add(const TriangleNet& net, int depth, Search& search);

bool add_pieces(const TensorNet& net, int depth, Search& search) {
  TensorNet half[2] = {TensorNet(net.m, net.n), TensorNet(net.m, net.n)};
  TensorNet quarter[2] = {half[0], half[1]};
  tensor_halve_u(net.points.data(), net.m, net.n, half[0].points.data(), half[1].points.data());
  for (const TensorNet& h : half) {
    tensor_halve_v(h.points.data(), net.m, net.n, quarter[0].points.data(), quarter[1].points.data());
    if (!add(quarter[0], depth + 1, search) || !add(quarter[1], depth + 1, search)) return false;
  }
  return true;
}

bool add_pieces(const TriangleNet& net, int depth, Search& search) {
  TriangleNet a(net.n), b(net.n), c(net.n), d(net.n);
  triangle_quarter(net.points.data(), net.n, a.points.data(), b.points.data(), c.points.data(),
                   d.points.data());
  return add(a, depth + 1, search) && add(b, depth + 1, search) && add(c, depth + 1, search) &&
         add(d, depth + 1, search);
}

template <class N>
bool add_piece(const N& net, int depth, Search& search) {
  // Each level halves both directions. A weight that is positive by 1% of its largest coefficient is resolved
  // within six levels; a thin set of pieces along a nearly vanishing weight may need more.
  constexpr int deepest = 12;
  // Looked at before giving up.
  constexpr int most_pieces = 20000;
  if (++search.pieces > most_pieces) return false;
  if (one_sign(net.points)) {
    add_hull(net.points, search.box);
    return true;
  }
  return depth < deepest && add_pieces(net, depth, search);
}

bool add(const TensorNet& net, int depth, Search& search) { return add_piece(net, depth, search); }
bool add(const TriangleNet& net, int depth, Search& search) { return add_piece(net, depth, search); }

bool finite(const std::vector<dvec4>& points) {
  return std::all_of(points.begin(), points.end(), [](const dvec4& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w);
  });
}

}  // namespace

std::optional<Box> bounds_of(const Net& net) {
  if (points_of(net).empty() || !finite(points_of(net))) return std::nullopt;
  Search search;
  if (!std::visit([&](const auto& n) { return add(n, 0, search); }, net)) return std::nullopt;
  for (int c = 0; c < 3; ++c) {
    if (!std::isfinite(search.box.low[c]) || !std::isfinite(search.box.high[c])) return std::nullopt;
  }
  return search.box;
}

}  // namespace rondure
