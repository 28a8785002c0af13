#include "renderer/camera/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "renderer/bezier/quotient.h"
#include "renderer/sampling/warps.h"

namespace rondure {
namespace {

constexpr double default_fov = 35.0;

double extent_of_fov(double degrees) { return 2.0 * std::tan(degrees * std::numbers::pi / 360.0); }

}  // namespace

Camera look_at(Projection projection, const dvec3& origin, const dvec3& target, const dvec3& up) {
  const dvec3 view = target - origin;
  const double distance = std::hypot(view.x, view.y, view.z);
  if (!(distance > 0.0)) throw std::invalid_argument("the camera's origin and target coincide");
  Camera camera;
  camera.projection = projection;
  camera.origin = origin;
  camera.forward = view / distance;
  const double size = std::max({std::fabs(up.x), std::fabs(up.y), std::fabs(up.z)});
  const dvec3 right = size > 0.0 ? glm::cross(camera.forward, up / size) : dvec3(0.0);
  // A few ulps of rounding in the cross product of parallel vectors must not pass for a direction.
  if (!(glm::length(right) > 1e-12)) {
    throw std::invalid_argument("the camera's up is zero or parallel to its view");
  }
  camera.right = glm::normalize(right);
  camera.up = glm::cross(camera.right, camera.forward);
  camera.extent = projection == Projection::perspective ? extent_of_fov(default_fov) : 2.5;
  camera.focus_distance = distance;
  return camera;
}

Camera default_camera() { return look_at(Projection::perspective, {0, -4, 1}, {0, 0, 0}, {0, 0, 1}); }

Ray camera_ray(const Camera& camera, double aspect, dvec2 film, dvec2 lens) {
  const double x = (film.x - 0.5) * camera.extent * aspect;
  const double y = (0.5 - film.y) * camera.extent;
  Ray ray;
  if (camera.projection == Projection::orthographic) {
    ray.origin = camera.origin + x * camera.right + y * camera.up;
    ray.direction = camera.forward;
    return ray;
  }
  const dvec3 direction = camera.forward + x * camera.right + y * camera.up;
  ray.origin = camera.origin;
  ray.direction = glm::normalize(direction);
  if (camera.aperture > 0.0) {
    const dvec2 d = camera.aperture * sample_disk(lens);
    const dvec3 offset = d.x * camera.right + d.y * camera.up;
    ray.origin += offset;
    ray.direction = glm::normalize(camera.focus_distance * direction - offset);
  }
  return ray;
}

dmat4 world_to_camera(const Camera& camera) {
  const dvec3 rows[3] = {camera.right, camera.up, -camera.forward};
  dmat4 matrix(1.0);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) matrix[c][r] = rows[r][c];
    matrix[3][r] = -glm::dot(rows[r], camera.origin);
  }
  return matrix;
}

dmat4 world_to_ndc(const Camera& camera, double aspect) {
  dmat4 projection(1.0);
  // An infinity would make the product's zeros no numbers.
  constexpr double most = std::numeric_limits<float>::max();
  projection[0][0] = std::fmin(quotient(2.0, camera.extent * aspect), most);
  projection[1][1] = std::fmin(quotient(2.0, camera.extent), most);
  projection[2][2] = -1.0;
  if (camera.projection == Projection::perspective) {
    // Divides by the distance along the view; z becomes 1 - 1 / distance.
    projection[2][3] = -1.0;
    projection[3][3] = 0.0;
    projection[3][2] = -1.0;
  }
  return projection * world_to_camera(camera);
}

}  // namespace rondure
