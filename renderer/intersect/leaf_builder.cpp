#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/leaf.h"

namespace rondure {
namespace {

// Contraction of Newton's method for a ray along the normal. Oblique rays see the leaf's curvature as well,
// and contract less; at 0.05 a tenth of the rays that hit a sphere are left undecided, at 0.1 a third, at
// 0.025 few, for twice the leaves.
constexpr double target_contraction = 0.05;
// Where the parametrisation is so even that the first is small on the whole of a curved patch (central
// projection of a plane, seen from that centre), this one tells. Elsewhere the first implies it.
constexpr double oblique_contraction = 0.4;
constexpr int weight_depth = 40;  // halvings after which a weight that is still not positive never will be

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

dvec4 abs_max(const dvec4& a, const dvec4& b) { return glm::max(a, glm::abs(b)); }

// |inverse of J| . (spreads), largest row sum, for the ray through the leaf's centre along which both planes
// lie.
double contraction(const Leaf& leaf, const dvec4& p0, const dvec4& p1) {
  const double a0 = glm::dot(p0, leaf.da), b0 = glm::dot(p0, leaf.db);
  const double a1 = glm::dot(p1, leaf.da), b1 = glm::dot(p1, leaf.db);
  const double s0 = glm::dot(glm::abs(p0), leaf.spread_a) + glm::dot(glm::abs(p0), leaf.spread_b);
  const double s1 = glm::dot(glm::abs(p1), leaf.spread_a) + glm::dot(glm::abs(p1), leaf.spread_b);
  const double in_a = std::fabs(b1) * s0 + std::fabs(b0) * s1, in_b = std::fabs(a1) * s0 + std::fabs(a0) * s1;
  return std::max(in_a, in_b) / std::fabs(a0 * b1 - a1 * b0);
}

// Whether Newton's method contracts as it should for the ray along the normal, and somewhat for rays at 45
// degrees to it; never where the surface has no normal.
bool contracts(const Leaf& leaf) {
  const dvec3 x = dvec3(leaf.center) / leaf.center.w;
  const dvec3 xa = (dvec3(leaf.da) - x * leaf.da.w) / leaf.center.w,
              xb = (dvec3(leaf.db) - x * leaf.db.w) / leaf.center.w;
  const double length_a = glm::length(xa);
  const dvec3 normal = glm::cross(xa, xb);
  if (!(glm::length(normal) > 1e-9 * length_a * glm::length(xb)) || !(length_a > 0.0)) return false;
  const dvec3 n = glm::normalize(normal), e0 = xa / length_a, e1 = glm::normalize(glm::cross(normal, xa));
  const auto plane = [&](const dvec3& across) { return dvec4(across, -glm::dot(across, x)); };
  if (!(contraction(leaf, plane(e0), plane(e1)) < target_contraction)) return false;
  for (const double side : {-1.0, 1.0}) {
    if (!(contraction(leaf, plane(glm::normalize(e0 + side * n)), plane(e1)) < oblique_contraction))
      return false;
    if (!(contraction(leaf, plane(e0), plane(glm::normalize(e1 + side * n))) < oblique_contraction))
      return false;
  }
  return true;
}

template <class Shape>
class Builder {
 public:
  Builder(const Shape& shape, const std::vector<dvec4>& net, int patch, int depth, LeafSet& out)
      : shape_(shape),
        net_(net),
        patch_(patch),
        depth_(depth),
        out_(out),
        magnitudes_(net.size()),
        points_(net.size()),
        inner_(net.size()) {
    for (std::size_t k = 0; k < net.size(); ++k) magnitudes_[k] = glm::abs(net[k]);
  }

  void divide(const typename Shape::Cell& cell, int depth) {
    const dvec4* net = net_.data();
    shape_.restrict_to(net, cell, points_.data());
    Box box;
    bool positive = true;
    for (const dvec4& p : points_) {
      positive = positive && p.w > 0.0;
      if (p.w > 0.0) box.add(dvec3(p) / p.w);
    }
    Leaf leaf;
    leaf.patch = patch_;
    place(cell, leaf);
    linearise(cell, leaf);
    const bool tame = positive && contracts(leaf);
    if (tame || (positive && depth >= depth_)) {
      some_tame_ = some_tame_ || tame;
      leaf.scale = scale_of(cell);
      out_.leaves.push_back(leaf);
      out_.boxes.push_back(box);
      return;
    }
    if (depth >= weight_depth)
      throw std::runtime_error(
          fmt::format("patch {}: a weight is not positive near (u, v) = ({:.6g}, {:.6g}), however "
                      "finely the patch is divided, so that it cannot be bounded",
                      patch_, leaf.to_patch(Shape::center()).x, leaf.to_patch(Shape::center()).y));
    typename Shape::Cell low, high;
    int edge;
    if constexpr (std::is_same_v<Shape, TensorShape>)
      edge = glm::length(size_a_) >= glm::length(size_b_) ? 0 : 1;
    else
      edge = Shape::longest_edge(cell);
    std::vector<dvec4> scratch(points_.size() * 2);
    shape_.halve(points_.data(), cell, edge, scratch.data(), scratch.data() + points_.size(), low, high);
    divide(low, depth + 1);
    divide(high, depth + 1);
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
  dvec3 size_a_{0.0}, size_b_{0.0};
  bool some_tame_ = false;

  NetScale scale_of(const typename Shape::Cell& cell) {
    shape_.restrict_to(magnitudes_.data(), cell, inner_.data());
    NetScale scale;
    for (const dvec4& p : inner_) {
      scale.position = std::fmax(scale.position, largest(dvec3(p)));
      scale.weight = std::fmax(scale.weight, std::fabs(p.w));
    }
    return scale;
  }

  void linearise(const typename Shape::Cell& cell, Leaf& leaf) {
    const dvec2 middle = Shape::to_patch(cell, Shape::center());
    const FirstOrder<dvec4> s = shape_.first(net_.data(), middle);
    leaf.center = s.value;
    leaf.da = leaf.edge_a.x * s.du + leaf.edge_a.y * s.dv;
    leaf.db = leaf.edge_b.x * s.du + leaf.edge_b.y * s.dv;
    leaf.spread_a = leaf.spread_b = dvec4(0.0);
    const dvec3 x = dvec3(s.value) / s.value.w;
    size_a_ = dvec3(leaf.da) - x * leaf.da.w, size_b_ = dvec3(leaf.db) - x * leaf.db.w;

    std::vector<dvec4> wide(points_.size());
    shape_.restrict_to(net_.data(), enlarged(cell), wide.data());
    if (shape_.can_derive_a()) {
      shape_.derive_a(wide.data(), inner_.data());
      for (int k = 0; k < shape_.derived_a().size(); ++k)
        leaf.spread_a =
            abs_max(leaf.spread_a, inner_[static_cast<std::size_t>(k)] / leaf_enlargement - leaf.da);
    }
    if (shape_.can_derive_b()) {
      shape_.derive_b(wide.data(), inner_.data());
      for (int k = 0; k < shape_.derived_b().size(); ++k)
        leaf.spread_b =
            abs_max(leaf.spread_b, inner_[static_cast<std::size_t>(k)] / leaf_enlargement - leaf.db);
    }
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
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const int patch = static_cast<int>(k);
    check_finite(points_of(patches[k]), patch);
    if (k < without.size() && without[k]) continue;
    const auto build = [&](auto shape, int degree, const std::vector<dvec4>& points) {
      if (degree > max_degree)
        throw std::runtime_error(fmt::format("patch {}: degree {} is above {}", patch, degree, max_degree));
      Builder<decltype(shape)> builder(shape, points, patch, max_depth, out);
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
