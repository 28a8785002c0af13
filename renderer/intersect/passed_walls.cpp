#include "renderer/intersect/passed_walls.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/intersect/contact.h"

namespace rondure {
namespace {

// Far more than what rounding puts between two walls in one place, but less than what turns their normals.
// Walls that are that near but apart are as well remembered: what is asked for is within rounding itself.
bool is_one_place(const Ray& ray, const Hit& hit) {
  const double length = largest(ray.direction), along = 16.0 * hit.t_error * length,
               across = hit.t_error * std::fabs(glm::dot(hit.normal, ray.direction));
  return std::fabs(hit.t) * length <=
         std::fmin(along, 0x1p20 * across) + 0x1p-46 * (largest(ray.origin) + largest(hit.point));
}

}  // namespace

bool PassedWalls::Wall::is(int other_surface, const dvec3& other_normal) const {
  if (surface != other_surface || !(glm::dot(normal, other_normal) > 0.0)) return false;
  const dvec3 apart = glm::cross(normal, other_normal);
  return glm::dot(apart, apart) < contact_angle * contact_angle;
}

void PassedWalls::arrive(const Ray& ray, const Hit& hit) {
  if (ray.start.surface < 0 || !hit || !is_one_place(ray, hit)) {
    count_ = 0;
    return;
  }
  forget(ray.start.surface, ray.start.normal);
  forget(hit.surface, hit.normal);
  if (count_ == walls_.size()) {
    std::move(walls_.begin() + 1, walls_.end(), walls_.begin());
    --count_;
  }
  walls_[count_++] = {ray.start.surface, glm::dot(ray.start.normal, ray.direction) > 0.0, ray.start.normal};
}

PassedWalls::Answer PassedWalls::ask(int surface, const dvec3& normal, const dvec3& direction) const {
  for (std::size_t k = count_; k-- > 0;)
    // By the normal that is asked about: where the ray grazes, a surface's two walls may both be there, and
    // the ray goes on to the other.
    if (walls_[k].is(surface, normal)) {
      const double way = glm::dot(normal, direction);
      return (walls_[k].outside ? way < 0.0 : way > 0.0) ? Answer::ahead : Answer::behind;
    }
  return Answer::unknown;
}

void PassedWalls::forget(int surface, const dvec3& normal) {
  const auto end = walls_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto kept =
      std::remove_if(walls_.begin(), end, [&](const Wall& wall) { return wall.is(surface, normal); });
  count_ = static_cast<std::size_t>(kept - walls_.begin());
}

}  // namespace rondure
