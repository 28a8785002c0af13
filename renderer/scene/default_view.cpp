#include "renderer/scene/default_view.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderer/bezier/box.h"

namespace rondure {
namespace {

// `origin`: of the surface's frame.
void add_surface(Box& box, const Surface& surface, const dvec3& origin) {
  if (surface.ellipsoid) {
    // A support function of the image of the unit sphere is the length of the row.
    for (int row = 0; row < 3; ++row) {
      dvec3 reach(0.0);
      const dmat3& m = *surface.ellipsoid;
      reach[row] = glm::length(dvec3(m[0][row], m[1][row], m[2][row]));
      box.add(origin + reach);
      box.add(origin - reach);
    }
  }
  for (const Net& net : surface.patches) {
    for (const dvec4& p : points_of(net)) {
      if (p.w > 0.0) box.add(origin + dvec3(p) / p.w);
    }
  }
}

Box box_of(const std::vector<SceneObject>& objects, const dvec3& about) {
  Box box;
  for (const SceneObject& object : objects)
    add_surface(box, object.traced.surface, object.traced.surface.origin - about);
  return box;
}

}  // namespace

Camera view_of(const std::vector<SceneObject>& objects, double aspect) {
  Box box = box_of(objects, dvec3(0.0));
  dvec3 center = box.center();
  const auto radius_of = [](const Box& b) { return 0.5 * glm::length(b.high - b.low); };
  // Of a scene that is small beside where it is, size and direction of the view would be rounding.
  const bool remote = radius_of(box) < 1e-6 * glm::length(center);
  if (remote) {
    const dvec3 about = objects.front().traced.surface.origin;
    box = box_of(objects, about);
    center = about + box.center();
  }
  const double radius = radius_of(box);
  if (!std::isfinite(radius) || !(radius > 0.0) || !std::isfinite(glm::length(center)))
    return default_camera();
  const double half = std::tan(0.5 * 35.0 * std::numbers::pi / 180.0);
  const double narrow = std::atan(half * std::fmin(1.0, aspect));
  const dvec3 toward_viewer = glm::normalize(dvec3(0.6, -1.0, 0.5));
  const double distance = radius / std::sin(narrow);
  const dvec3 target = remote ? dvec3(0.0) : center;
  Camera camera =
      look_at(Projection::perspective, target + toward_viewer * distance, target, dvec3(0.0, 0.0, 1.0));
  camera.origin = center + toward_viewer * distance;
  camera.extent = 2.0 * half;
  camera.focus_distance = distance;
  return camera;
}

}  // namespace rondure
