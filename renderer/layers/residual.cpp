// How far the hit is from where it should be.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/layers/layers.h"

namespace rondure {
namespace {

void residual(const World& world, const Ray& ray, const Hit& hit, double* values) {
  if (!hit) return;
  // Distance of the point from the ray's line.
  const dvec3 along = glm::normalize(ray.direction);
  values[1] = glm::length(glm::cross(hit.point - ray.origin, along));
  const Surface& surface = world.tracer().surfaces()[static_cast<std::size_t>(hit.surface)].surface;
  if (surface.ellipsoid) {
    // |q| - 1 in the frame of the unit sphere, as a length along the gradient.
    const dmat3 back = glm::inverse(*surface.ellipsoid);
    const dvec3 q = back * (hit.point - surface.origin);
    values[0] = std::abs(glm::length(q) - 1.0) / glm::length(glm::transpose(back) * glm::normalize(q));
    return;
  }
  const PatchQuadric* q = world.normals(hit.surface).quadric(hit.patch);
  // In the surface's own frame, where its place in the world rounds nothing.
  const dvec3 point = net_point(*net_at(world, hit), hit.u, hit.v);
  values[0] = q ? q->quadric.distance(point) : -1.0;
}

}  // namespace

void register_residual_layer(Registry& registry) {
  registry.add(
      LayerFactory{"residual",
                   "Distances of the hit from the quadric that the patch lies on, |f| / |grad f| (-1 where "
                   "there is none), and from the ray.",
                   "Residual",
                   {"implicit", "ray"},
                   {},
                   [](Params&) { return LayerFunction(residual); },
                   {"scene units", "scene units"}});
}

}  // namespace rondure
