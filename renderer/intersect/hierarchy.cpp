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
    const double reach = glm::length(glm::max(glm::abs(box.low), glm::abs(box.high)));
    radius_ = std::max(radius_, std::isnan(reach) ? INFINITY : reach);  // of a box that overflowed
  }
  if (!(radius_ >= smallest_scene && radius_ <= largest_scene))
    throw std::runtime_error(fmt::format("the scene is too {}: its radius must be between {:g} and {:g}",
                                         radius_ < smallest_scene ? "small" : "large", smallest_scene,
                                         largest_scene));
  unit_ = std::ldexp(1.0, -std::ilogb(radius_)), inverse_unit_ = 1.0 / unit_;
  for (Box& box : boxes) box.low *= unit_, box.high *= unit_;
  embree_ = std::make_unique<EmbreeScene>(boxes, std::move(names), radius_ * unit_, visitor);
}

bool Hierarchy::enter(const LocalRay& local, double t_min, double t_max, Entry& entry) const {
  const dvec3 base = (local.base - center_) * unit_;
  const double shift = -glm::dot(base, local.direction) * local.inverse_length2;
  return enter(local, base + shift * local.direction, local.slide * unit_ + shift, t_min, t_max, entry);
}

bool Hierarchy::enter(const LocalRay& local, dvec3 base, double slide, double t_min, double t_max,
                      Entry& entry) const {
  // From so far away rounding may leave the base beside the middle of the ray's chord.
  if (std::fabs(slide) > 0x1p40) {
    const double shift = -glm::dot(base, local.direction) * local.inverse_length2;
    base += shift * local.direction, slide += shift;
  }
  const double b2 = glm::dot(base, base), r = radius_ * unit_ * (1.0 + 1e-9);
  if (!(b2 <= r * r)) return false;
  const double half = std::sqrt((r * r - b2) * local.inverse_length2);
  const double start = t_min * local.inverse_scale * unit_ - slide,
               end = t_max * local.inverse_scale * unit_ - slide;
  // A start on a surface may lie an error bound behind the first root that counts.
  const double near = std::max(start - 1e-9 * half, -half);
  if (!(near <= half) || !(end >= near)) return false;
  entry.origin = base + near * local.direction;
  entry.far = std::min(half, end) - near;
  entry.far_origin = (slide + near) * inverse_unit_ * local.scale;
  entry.far_rate = unit_ * local.inverse_scale;
  return true;
}

}  // namespace rondure
