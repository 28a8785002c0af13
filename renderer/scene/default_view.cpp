#include "renderer/scene/default_view.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderer/bezier/box.h"

namespace rondure {
namespace {

void add_surface(Box& box, const Surface& surface) {
  if (surface.ellipsoid) {
    // A support function of the image of the unit sphere is the length of the row.
    for (int row = 0; row < 3; ++row) {
      dvec3 reach(0.0);
      const dmat3& m = *surface.ellipsoid;
      reach[row] = glm::length(dvec3(m[0][row], m[1][row], m[2][row]));
      box.add(surface.origin + reach);
      box.add(surface.origin - reach);
    }
  }
  for (const Net& net : surface.patches) {
    for (const dvec4& p : points_of(net)) {
      if (p.w > 0.0) box.add(surface.origin + dvec3(p) / p.w);
    }
  }
}

}  // namespace

Camera view_of(const std::vector<SceneObject>& objects, double aspect) {
  Box box;
  for (const SceneObject& object : objects) add_surface(box, object.traced.surface);
  const dvec3 center = box.center();
  const double radius = 0.5 * glm::length(box.high - box.low);
  if (!std::isfinite(radius) || !(radius > 0.0) || !std::isfinite(glm::length(center)))
    return default_camera();
  const double half = std::tan(0.5 * 35.0 * std::numbers::pi / 180.0);
  const double narrow = std::atan(half * std::fmin(1.0, aspect));
  const dvec3 toward_viewer = glm::normalize(dvec3(0.6, -1.0, 0.5));
  const double distance = radius / std::sin(narrow);
  Camera camera =
      look_at(Projection::perspective, center + toward_viewer * distance, center, dvec3(0.0, 0.0, 1.0));
  camera.extent = 2.0 * half;
  camera.focus_distance = distance;
  return camera;
}

}  // namespace rondure
