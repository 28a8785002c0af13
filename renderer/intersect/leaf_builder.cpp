#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "renderer/bezier/corners.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/leaf_frame.h"
#include "renderer/intersect/restriction.h"

namespace rondure {
namespace {

// How even a leaf is to be (leaf_frame.h). Half of either costs twice the leaves and their memory, which
// outweighs the steps and searches that it saves; twice of either costs as many of these.
constexpr double straight_target = 0.19;
constexpr double oblique_target = 0.20;
constexpr int weight_depth = 40;  // halvings after which a weight that is still not positive never will be
// Cells that a patch may be divided into beyond its depth until their weights are positive. Beside a zero of
// the weight there are some at each halving; where the weight all but vanishes along a curve, without end.
constexpr int most_beyond_depth = 1 << 16;
// Rounding is relative to a leaf's largest weight: beside a place of little weight cells are divided beyond
// their depth until theirs differ by no more than this, or twice as many are as the depth allows, or these.
constexpr double most_unequal = 4.0;
constexpr std::size_t least_unequal_divisions = 32;

RectangleCell enlarged(const RectangleCell& c) {
  const dvec2 middle = 0.5 * (c.low + c.high);
  return {middle + leaf_enlargement * (c.low - middle), middle + leaf_enlargement * (c.high - middle)};
}

TriangleCell enlarged(const TriangleCell& c) {
  const dvec2 middle = (c.corner[0] + c.corner[1] + c.corner[2]) / 3.0;
  TriangleCell out;
  for (int k = 0; k < 3; ++k) out.corner[k] = middle + leaf_enlargement * (c.corner[k] - middle);
  return out;
}

void place(const RectangleCell& c, Leaf& leaf) {
  leaf.corner = c.low;
  leaf.edge_a = dvec2(c.high.x - c.low.x, 0.0);
  leaf.edge_b = dvec2(0.0, c.high.y - c.low.y);
}

void place(const TriangleCell& c, Leaf& leaf) {
  leaf.corner = c.corner[2];
  leaf.edge_a = c.corner[0] - c.corner[2];
  leaf.edge_b = c.corner[1] - c.corner[2];
}

// What one patch after another is cut with.
template <class Shape>
struct Scratch {
  Restriction<Shape> restriction;
  std::vector<dvec4> points, wide;
};

template <class Shape>
class Builder {
 public:
  Builder(const Shape& shape, const std::vector<dvec4>& net, int patch, int depth, Scratch<Shape>& scratch,
          LeafSet& out)
      : shape_(shape), net_(net.data()), patch_(patch), depth_(depth), scratch_(scratch), out_(out) {
    scratch.restriction.start(shape, net);
    scratch.points.resize(net.size()), scratch.wide.resize(net.size());
  }

  void build() {
    divide({}, 0);
    even_out();
  }

  bool some_tame() const { return some_tame_; }

 private:
  const Shape shape_;
  const dvec4* const net_;
  const int patch_;
  const int depth_;
  Scratch<Shape>& scratch_;
  LeafSet& out_;
  bool some_tame_ = false;
  int beyond_depth_ = 0;  // cells divided there

  struct Deep {
    typename Shape::Cell cell;
    int depth;
  };
  std::vector<Deep> unequal_;  // cells of unequal weights that are no leaves yet

  // A cell that may be a leaf.
  struct Piece {
    Leaf leaf;
    SecondOrder<dvec4> center;
    bool positive = false, equal = true;  // the weights
    bool tame = false;                    // Newton's method decides nearly all rays
    Evenness evenness;
  };

  Piece piece_of(const typename Shape::Cell& cell) const {
    Piece piece;
    piece.leaf.patch = patch_;
    place(cell, piece.leaf);
    piece.center =
        scratch_.restriction.arithmetic.second(shape_, net_, Shape::to_patch(cell, Shape::center()));
    return piece;
  }

  // Restricts the net to the cell, in scratch_.points.
  void examine(const typename Shape::Cell& cell, Piece& piece) {
    Restriction<Shape>& restriction = scratch_.restriction;
    const dvec4 *points = scratch_.points.data(), *wide = scratch_.wide.data();
    restriction.points(cell, scratch_.points.data());
    const auto [least, most] = weights_of(points);
    piece.positive = least > 0.0, piece.equal = most <= most_unequal * least;
    if (!piece.positive) return;
    piece.leaf.scale = restriction.scale(cell);
    restriction.points(enlarged(cell), scratch_.wide.data());
    piece.evenness = set_frame(shape_, restriction.arithmetic, restriction.parameters, piece.center, points,
                               wide, piece.leaf);
    piece.tame = piece.evenness.straight < straight_target && piece.evenness.oblique < oblique_target;
  }

  // Of the piece that has been examined last.
  void keep(const Piece& piece) {
    some_tame_ = some_tame_ || piece.tame;
    out_.leaves.push_back(piece.leaf);
    out_.boxes.push_back(scratch_.restriction.arithmetic.box(shape_.size(), scratch_.points.data()));
  }

  // `uneven`: how many more halvings there must be, at least, before a leaf can be tame.
  void divide(const typename Shape::Cell& cell, int depth, int uneven = 0) {
    Piece piece = piece_of(cell);
    if (uneven == 0 || depth >= depth_) {
      examine(cell, piece);
      if (piece.tame || (piece.positive && depth >= depth_)) {
        if (piece.tame || piece.equal)
          keep(piece);
        else
          unequal_.push_back({cell, depth});
        return;
      }
      uneven = piece.equal ? halvings_left(piece.evenness) : 0;
    }
    if (depth >= weight_depth || (depth >= depth_ && ++beyond_depth_ > most_beyond_depth))
      throw std::runtime_error(fmt::format(
          "patch {}: a weight is not positive near (u, v) = ({:.6g}, {:.6g}), or next to nothing "
          "beside the largest, however finely the patch is divided, so that it cannot be bounded",
          patch_, piece.leaf.to_patch(Shape::center()).x, piece.leaf.to_patch(Shape::center()).y));
    typename Shape::Cell low, high;
    int edge;
    if constexpr (std::is_same_v<Shape, TensorShape>)
      edge = (piece.positive && !piece.equal ? longer_along_a() : longer_along_a(piece.center, piece.leaf))
                 ? 0
                 : 1;
    else
      edge = Shape::longest_edge(cell);
    Shape::halve(cell, edge, low, high);
    divide(low, depth + 1, std::max(uneven - 1, 0));
    divide(high, depth + 1, std::max(uneven - 1, 0));
  }

  // Divides what cells of unequal weights there are, the largest first, across the sides along which the
  // weights differ.
  void even_out() {
    std::size_t divisions = std::max(std::size_t{2} << depth_, least_unequal_divisions);
    for (std::size_t k = 0; k < unequal_.size(); ++k) {
      const auto [cell, depth] = unequal_[k];
      Piece piece = piece_of(cell);
      examine(cell, piece);
      if (piece.tame || piece.equal || depth >= weight_depth || divisions == 0) {
        keep(piece);
        continue;
      }
      --divisions;
      typename Shape::Cell low, high;
      int edge;
      if constexpr (std::is_same_v<Shape, TensorShape>)
        edge = more_unequal_along_a() ? 0 : 1;
      else
        edge = Shape::longest_edge(cell);
      Shape::halve(cell, edge, low, high);
      unequal_.push_back({low, depth + 1});
      unequal_.push_back({high, depth + 1});
    }
  }

  // Unevenness halves with the leaf's size at best, for which each parameter must be halved; to be safe, only
  // what is far too uneven goes unexamined.
  static int halvings_left(const Evenness& e) {
    const double excess = std::max(e.straight / straight_target, e.oblique / oblique_target);
    return excess < 1e6 ? std::max(static_cast<int>(2.0 * std::log2(excess)) - 3, 0) : 0;
  }

  std::pair<double, double> weights_of(const dvec4* points) const {
    double least = points[0].w, most = least;
    for (int k = 1; k < shape_.size(); ++k)
      least = std::min(least, points[k].w), most = std::max(most, points[k].w);
    return {least, most};
  }

  // Whether weights of the cell last examined differ more along a than along b.
  bool more_unequal_along_a() const {
    const auto& [m, n] = shape_;
    const int stride = n + 1;
    const auto spread = [&](int lines, int across, int along, int step) {
      double most = 1.0;
      for (int i = 0; i < lines; ++i) {
        const dvec4* const line = scratch_.points.data() + i * across;
        double low = line->w, high = low;
        for (int j = 1; j <= along; ++j)
          low = std::min(low, line[j * step].w), high = std::max(high, line[j * step].w);
        most = std::max(most, high / low);
      }
      return most;
    };
    return spread(n + 1, 1, m, stride) >= spread(m + 1, stride, n, 1);
  }

  // Whether the control net of the cell last examined is longer along a than along b: where weights are
  // unequal, most of a surface is where its centre tells nothing of.
  bool longer_along_a() const {
    const int m = shape_.m, n = shape_.n;
    const auto at = [&](int i, int j) {
      const dvec4& p = scratch_.points[static_cast<std::size_t>(i * (n + 1) + j)];
      return dvec3(p) / p.w;
    };
    double a = 0.0, b = 0.0;
    for (int i = 0; i <= m; ++i)
      for (int j = 0; j <= n; ++j) {
        if (i < m) a += glm::distance(at(i, j), at(i + 1, j)) / (n + 1);
        if (j < n) b += glm::distance(at(i, j), at(i, j + 1)) / (m + 1);
      }
    return a >= b;
  }

  // Whether the surface is longer along a than along b.
  static bool longer_along_a(const SecondOrder<dvec4>& s, const Leaf& leaf) {
    const dvec3 x = s.value.w != 0.0 ? dvec3(s.value) / s.value.w : dvec3(0.0);
    return leaf.edge_a.x * glm::length(dvec3(s.du) - x * s.du.w) >=
           leaf.edge_b.y * glm::length(dvec3(s.dv) - x * s.dv.w);
  }
};

// A patch without a normal anywhere is a curve or a point: every ray that meets it does so at no isolated
// parameter.
void check_area(const Net& net, int patch) {
  for (const double u : {0.21, 0.47, 0.11})
    for (const double v : {0.33, 0.07, 0.52})
      if (unit_normal(net, u, v) != dvec3(0.0)) return;
  throw std::runtime_error(
      fmt::format("patch {}: has no area; its control points lie on a curve or in a point", patch));
}

void check_finite(const std::vector<dvec4>& points, int patch) {
  for (const dvec4& p : points)
    if (!is_finite(dvec3(p)) || !std::isfinite(p.w))
      throw std::runtime_error(fmt::format("patch {}: a control point is not finite", patch));
}

// Beside a corner of next to no weight the net is as small, and its rounding is not: every ray would pass
// there.
void check_corners(const Net& net, int patch) {
  constexpr double least = 1e-16;
  double most = 0.0, lightest = INFINITY;
  for (const dvec4& p : points_of(net)) most = std::fmax(most, std::fabs(p.w));
  const auto corners = std::visit([](const auto& n) { return corners_of(n); }, net);
  for (const dvec4& p : corners) lightest = std::fmin(lightest, p.w);
  if (lightest > 0.0 && lightest < least * most)
    throw std::runtime_error(
        fmt::format("patch {}: the weight of a corner is {:.3g} of the largest, and less than {:g}, so that "
                    "doubles do not tell where the patch is beside it",
                    patch, lightest / most, least));
}

}  // namespace

LeafSet build_leaves(const std::vector<Net>& patches, int max_depth, const std::vector<bool>& without) {
  // What these know serves the next surface too.
  static thread_local Scratch<TensorShape> for_rectangles;
  static thread_local Scratch<TriangleShape> for_triangles;
  LeafSet out;
  const std::size_t likely = patches.size() << std::min(max_depth, 2);
  out.leaves.reserve(likely), out.boxes.reserve(likely);
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const int patch = static_cast<int>(k);
    const std::vector<dvec4>& points = points_of(patches[k]);
    check_finite(points, patch);
    check_corners(patches[k], patch);
    if (k < without.size() && without[k]) continue;
    const auto build = [&](auto shape, int degree, auto& scratch) {
      if (degree > max_degree)
        throw std::runtime_error(fmt::format("patch {}: degree {} is above {}", patch, degree, max_degree));
      Builder<decltype(shape)> builder(shape, points, patch, max_depth, scratch, out);
      builder.build();
      if (!builder.some_tame()) check_area(patches[k], patch);
    };
    if (const auto* tensor = std::get_if<TensorNet>(&patches[k]))
      build(TensorShape{tensor->m, tensor->n}, std::max(tensor->m, tensor->n), for_rectangles);
    else
      build(TriangleShape{std::get<TriangleNet>(patches[k]).n}, std::get<TriangleNet>(patches[k]).n,
            for_triangles);
  }
  out.leaves.shrink_to_fit(), out.boxes.shrink_to_fit();
  return out;
}

}  // namespace rondure
