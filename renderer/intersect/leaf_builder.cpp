#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

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

template <class Shape>
class Builder {
 public:
  Builder(const Shape& shape, const std::vector<dvec4>& net, int patch, int depth, Restriction& restriction,
          LeafSet& out)
      : shape_(shape),
        net_(net),
        patch_(patch),
        depth_(depth),
        out_(out),
        magnitudes_(net.size()),
        points_(net.size()),
        inner_(net.size()),
        restrict_(restriction) {
    for (std::size_t k = 0; k < net.size(); ++k) magnitudes_[k] = glm::abs(net[k]);
  }

  // `uneven`: how many more halvings there must be, at least, before a leaf can be tame.
  void divide(const typename Shape::Cell& cell, int depth, int uneven = 0) {
    const dvec4* net = net_.data();
    Leaf leaf;
    leaf.patch = patch_;
    place(cell, leaf);
    const SecondOrder<dvec4> center = shape_.second(net, Shape::to_patch(cell, Shape::center()));
    bool positive = false;
    if (uneven == 0 || depth >= depth_) {
      restrict_(shape_, net, cell, points_.data());
      Box box;
      positive = true;
      for (const dvec4& p : points_) {
        positive = positive && p.w > 0.0;
        if (p.w > 0.0) box.add(dvec3(p) / p.w);
      }
      Evenness evenness;
      if (positive) {
        leaf.scale = scale_of(cell);
        restrict_(shape_, net, enlarged(cell), inner_.data());
        evenness = set_frame(shape_, center, points_, inner_, leaf);
      }
      const bool tame = evenness.straight < straight_target && evenness.oblique < oblique_target;
      if (tame || (positive && depth >= depth_)) {
        some_tame_ = some_tame_ || tame;
        out_.leaves.push_back(leaf);
        out_.boxes.push_back(box);
        return;
      }
      uneven = halvings_left(evenness);
    }
    if (depth >= weight_depth || (depth >= depth_ && ++beyond_depth_ > most_beyond_depth))
      throw std::runtime_error(
          fmt::format("patch {}: a weight is not positive near (u, v) = ({:.6g}, {:.6g}), however "
                      "finely the patch is divided, so that it cannot be bounded",
                      patch_, leaf.to_patch(Shape::center()).x, leaf.to_patch(Shape::center()).y));
    typename Shape::Cell low, high;
    int edge;
    if constexpr (std::is_same_v<Shape, TensorShape>)
      edge = longer_across_a(center, leaf) ? 0 : 1;
    else
      edge = Shape::longest_edge(cell);
    Shape::halve(cell, edge, low, high);
    divide(low, depth + 1, std::max(uneven - 1, 0));
    divide(high, depth + 1, std::max(uneven - 1, 0));
  }

  bool some_tame() const { return some_tame_; }

 private:
  const Shape shape_;
  const std::vector<dvec4>& net_;
  const int patch_;
  const int depth_;
  LeafSet& out_;
  std::vector<dvec4> magnitudes_;  // |P_ij|, componentwise
  std::vector<dvec4> points_, inner_;
  Restriction& restrict_;
  bool some_tame_ = false;
  int beyond_depth_ = 0;  // cells divided there

  // Unevenness halves with the leaf's size at best, for which each parameter must be halved; to be safe, only
  // what is far too uneven goes unexamined.
  static int halvings_left(const Evenness& e) {
    const double excess = std::max(e.straight / straight_target, e.oblique / oblique_target);
    return excess < 1e6 ? std::max(static_cast<int>(2.0 * std::log2(excess)) - 3, 0) : 0;
  }

  NetScale scale_of(const typename Shape::Cell& cell) {
    restrict_(shape_, magnitudes_.data(), cell, inner_.data());
    NetScale scale;
    for (const dvec4& p : inner_) {
      scale.position = std::fmax(scale.position, largest(dvec3(p)));
      scale.weight = std::fmax(scale.weight, std::fabs(p.w));
    }
    return scale;
  }

  // Whether the surface is longer along a than along b.
  static bool longer_across_a(const SecondOrder<dvec4>& s, const Leaf& leaf) {
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

}  // namespace

LeafSet build_leaves(const std::vector<Net>& patches, int max_depth, const std::vector<bool>& without) {
  LeafSet out;
  static thread_local Restriction restriction;  // what it knows serves the next surface too
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const int patch = static_cast<int>(k);
    check_finite(points_of(patches[k]), patch);
    if (k < without.size() && without[k]) continue;
    const auto build = [&](auto shape, int degree, const std::vector<dvec4>& points) {
      if (degree > max_degree)
        throw std::runtime_error(fmt::format("patch {}: degree {} is above {}", patch, degree, max_degree));
      Builder<decltype(shape)> builder(shape, points, patch, max_depth, restriction, out);
      builder.divide({}, 0);
      if (!builder.some_tame()) check_area(patches[k], patch);
    };
    if (const auto* tensor = std::get_if<TensorNet>(&patches[k]))
      build(TensorShape{tensor->m, tensor->n}, std::max(tensor->m, tensor->n), tensor->points);
    else
      build(TriangleShape{std::get<TriangleNet>(patches[k]).n}, std::get<TriangleNet>(patches[k]).n,
            points_of(patches[k]));
  }
  return out;
}

}  // namespace rondure
