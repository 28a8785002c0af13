// The leaves of a small surface, met together. In a scene of very many of these one hierarchy of all leaves
// costs more, to build and in memory, than the leaves themselves; one of the surfaces does not.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "renderer/bezier/box.h"
#include "renderer/intersect/local_ray.h"

namespace rondure {

class LeafCluster {
 public:
  static constexpr std::size_t most_leaves = 64;
  static constexpr std::size_t lanes = 4;

  // A ray's way through the box of a leaf begins at `enter`, in the ray's own steps (local_ray.h).
  struct Met {
    double enter;
    unsigned leaf;
  };
  using AllMet = std::array<Met, most_leaves>;

  LeafCluster() = default;
  // The boxes, in the surface's frame, of so many leaves at most. Those that follow one another are best near
  // each other.
  explicit LeafCluster(const std::vector<Box>& boxes);

  bool empty() const { return boxes_.empty(); }
  // Where the boxes are.
  std::span<const std::byte> memory() const { return std::as_bytes(std::span(boxes_)); }

  // The last step at which a box may begin that has a root of the ray before the step `to`.
  double last_step(const LocalRay& ray, double to) const {
    // A root beside the ray's end may count; 2^-19 radii is what Embree is given, too.
    return to + (0x1p-19 * radius_ * std::sqrt(ray.inverse_length2) + 1e-12 * std::fabs(ray.slide));
  }
  // Those whose boxes the ray meets between the steps `from` and `to`, the nearest first; how many there are.
  std::size_t meet(const LocalRay& ray, double from, double to, AllMet& out) const;

  // visit(leaf) for each whose box meets(box) says may be met, the box being within the one of its group, for
  // which it said so too. The boxes are about `center`.
  template <class Meets, class Visit>
  void visit(const Meets& meets, const Visit& visit) const {
    for (std::size_t group = 0; lanes * group < leaf_count_; ++group) {
      if (!meets(boxes_[group / lanes].box(group % lanes))) continue;
      const Boxes& inner = boxes_[outer_count() + group];
      for (std::size_t k = 0; k < lanes && lanes * group + k < leaf_count_; ++k)
        if (meets(inner.box(k))) visit(static_cast<unsigned>(lanes * group + k));
    }
  }
  const dvec3& center() const { return center_; }
  // Of the boxes' corners, from the frame's zero.
  double reach() const { return reach_; }

 private:
  // As many boxes, rounded outward.
  struct Boxes {
    float low[3][lanes], high[3][lanes];

    Box box(std::size_t k) const {
      return {{low[0][k], low[1][k], low[2][k]}, {high[0][k], high[1][k], high[2][k]}};
    }
  };

  dvec3 center_{0.0};
  double reach_ = 0.0, radius_ = 0.0;
  std::size_t leaf_count_ = 0;
  std::vector<Boxes> boxes_;  // of the groups of as many leaves as lanes, and then of the leaves

  static std::size_t groups_of(std::size_t count) { return (count + lanes - 1) / lanes; }
  std::size_t outer_count() const { return groups_of(groups_of(leaf_count_)); }
};

}  // namespace rondure
