#include "renderer/intersect/leaf_cluster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rondure {
namespace {

// To a float that is less, or more.
float down(double x) {
  const auto rounded = static_cast<float>(x);
  return rounded - (0x1p-22f * std::fabs(rounded) + std::numeric_limits<float>::min());
}
float up(double x) { return -down(-x); }

// As a box that no ray meets would be none to its arithmetic, lanes without one have the last again; they are
// told apart by their number.
template <class Boxes>
std::vector<Box> put_boxes(const std::vector<Box>& boxes, const dvec3& center, Boxes* out) {
  constexpr std::size_t lanes = LeafCluster::lanes;
  std::vector<Box> groups;
  for (std::size_t k = 0; k < boxes.size(); k += lanes, ++out) {
    Box group;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Box& box = boxes[std::min(k + lane, boxes.size() - 1)];
      group.add(box);
      for (int axis = 0; axis < 3; ++axis) {
        out->low[axis][lane] = down(box.low[axis] - center[axis]);
        out->high[axis][lane] = up(box.high[axis] - center[axis]);
      }
    }
    groups.push_back(group);
  }
  return groups;
}

}  // namespace

LeafCluster::LeafCluster(const std::vector<Box>& boxes) : leaf_count_(boxes.size()) {
  Box bounds;
  for (const Box& box : boxes) bounds.add(box);
  center_ = bounds.center();
  reach_ = std::max(largest(bounds.low), largest(bounds.high));
  radius_ = glm::distance(bounds.high, center_);
  boxes_.resize(outer_count() + groups_of(boxes.size()));
  put_boxes(put_boxes(boxes, center_, &boxes_[outer_count()]), center_, boxes_.data());
}

std::size_t LeafCluster::meet(const LocalRay& ray, double from, double to, AllMet& out) const {
  // One over a component that is none is large, but not so large that its product with zero is no number.
  constexpr double most = 1e300;
  const dvec3 base = ray.base - center_;
  // A root may lie beside its box by rounding.
  const double room = 1e-12 * (largest(ray.base) + reach_);
  from -= last_step(ray, 0.0), to = last_step(ray, to);
  double inverse[3], below[3], above[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    inverse[axis] = std::fabs(d) > 1.0 / most ? 1.0 / d : std::copysign(most, d);
    below[axis] = base[axis] + room, above[axis] = base[axis] - room;
  }
  const auto test = [&](const Boxes& boxes, double* enter, bool* meets) {
    double leave[lanes];
    for (std::size_t k = 0; k < lanes; ++k) enter[k] = from, leave[k] = to;
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t k = 0; k < lanes; ++k) {
        const double a = (static_cast<double>(boxes.low[axis][k]) - below[axis]) * inverse[axis],
                     b = (static_cast<double>(boxes.high[axis][k]) - above[axis]) * inverse[axis];
        enter[k] = std::max(enter[k], std::min(a, b)), leave[k] = std::min(leave[k], std::max(a, b));
      }
    for (std::size_t k = 0; k < lanes; ++k) meets[k] = enter[k] <= leave[k];
  };

  std::size_t count = 0;
  const std::size_t groups = groups_of(leaf_count_), outer = outer_count();
  for (std::size_t first = 0; first < groups; first += lanes) {
    double ignored[lanes];
    bool meets_group[lanes];
    test(boxes_[first / lanes], ignored, meets_group);
    for (std::size_t group = first; group < std::min(first + lanes, groups); ++group) {
      if (!meets_group[group - first]) continue;
      double enter[lanes];
      bool meets[lanes];
      test(boxes_[outer + group], enter, meets);
      for (std::size_t k = 0; k < lanes && lanes * group + k < leaf_count_; ++k) {
        if (!meets[k]) continue;
        std::size_t at = count++;
        for (; at > 0 && out[at - 1].enter > enter[k]; --at) out[at] = out[at - 1];
        out[at] = {enter[k], static_cast<unsigned>(lanes * group + k)};
      }
    }
  }
  return count;
}

}  // namespace rondure
