#include "renderer/intersect/hierarchy.h"

#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <stdexcept>

namespace rondure {
namespace {

// Beyond these, squares and products of coordinates leave the range of doubles.
constexpr double smallest_scene = 1e-60, largest_scene = 1e60;

}  // namespace

Hierarchy::Hierarchy(const dvec3& center, std::vector<Box> boxes, std::vector<LeafName> names,
                     EmbreeScene::Visitor visitor)
    : center_(center) {
  for (const Box& box : boxes) {
    radius_ = std::max(radius_, glm::length(glm::max(glm::abs(box.low), glm::abs(box.high))));
  }
  if (!(radius_ >= smallest_scene && radius_ <= largest_scene))
    throw std::runtime_error(fmt::format("the scene is too {}: its radius must be between {:g} and {:g}",
                                         radius_ < smallest_scene ? "small" : "large", smallest_scene,
                                         largest_scene));
  unit_ = std::ldexp(1.0, -std::ilogb(radius_));
  for (Box& box : boxes) box.low *= unit_, box.high *= unit_;
  embree_ = std::make_unique<EmbreeScene>(boxes, std::move(names), radius_ * unit_, visitor);
}

bool Hierarchy::enter(const LocalRay& local, const dvec3& center, double t_min, double t_max,
                      Entry& entry) const {
  const dvec3& d = local.direction;
  dvec3 base = (local.base - center) * unit_;
  const double shift = -glm::dot(base, d) / local.length2;
  base += shift * d;
  const double slide = local.slide * unit_ + shift;
  const double b2 = glm::dot(base, base), r = radius_ * unit_ * (1.0 + 1e-9);
  if (!(b2 <= r * r)) return false;
  const double half = std::sqrt((r * r - b2) / local.length2);
  const double start = t_min / local.scale * unit_ - slide, end = t_max / local.scale * unit_ - slide;
  // A start on a surface may lie an error bound behind the first root that counts.
  const double near = std::max(start - 1e-9 * half, -half);
  if (!(near <= half) || !(end >= near)) return false;
  entry.origin = base + near * d;
  entry.far = std::min(half, end) - near;
  entry.far_origin = (slide + near) / unit_ * local.scale;
  entry.far_scale = local.scale / unit_;
  return true;
}

}  // namespace rondure
