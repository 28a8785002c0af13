// The surface's curvature at the hit, and how far it is from the quadric's.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/layers/layers.h"

namespace rondure {
namespace {

// Of the image of the unit sphere under a linear map, at a point p of it: f = |M^-1 p|^2 - 1.
QuadricCurvature ellipsoid_curvature(const dmat3& map, const dvec3& p) {
  ImplicitQuadric q;
  const dmat3 back = glm::inverse(map);
  q.a = glm::transpose(back) * back;
  q.c = -1.0;
  return quadric_curvature(q, p, 1.0);
}

void curvature_at(const World& world, const Ray&, const Hit& hit, double* values) {
  if (!hit) return;
  values[2] = values[3] = -1.0;
  const Surface& surface = world.tracer().surfaces()[static_cast<std::size_t>(hit.surface)].surface;
  if (surface.ellipsoid) {
    const QuadricCurvature exact = ellipsoid_curvature(*surface.ellipsoid, hit.point - surface.origin);
    values[0] = exact.gaussian, values[1] = exact.mean;
    values[2] = values[3] = 0.0;
    return;
  }
  const Net& net = *net_at(world, hit);
  const Curvature own = curvature(net, hit.u, hit.v);
  const bool finite = std::isfinite(own.gaussian) && std::isfinite(own.mean);
  values[0] = finite ? own.gaussian : 0.0, values[1] = finite ? own.mean : 0.0;
  const PatchQuadric* q = world.normals(hit.surface).quadric(hit.patch);
  if (!q || !finite) return;
  const QuadricCurvature exact = quadric_curvature(q->quadric, net_point(net, hit.u, hit.v), q->sign);
  if (!std::isfinite(exact.gaussian) || !std::isfinite(exact.mean)) return;
  values[2] = std::abs(own.gaussian - exact.gaussian);
  values[3] = std::abs(own.mean - exact.mean);
}

}  // namespace

void register_curvature_layer(Registry& registry) {
  registry.add(
      LayerFactory{"curvature",
                   "Gaussian and mean curvature, and how far each is from that of the quadric that the patch "
                   "lies on (-1 where there is none, or no curvature).",
                   "Curvature",
                   {"gaussian", "mean", "gaussian_error", "mean_error"},
                   {},
                   [](Params&) { return LayerFunction(curvature_at); },
                   {"1/length²", "1/length", "1/length²", "1/length"}});
}

}  // namespace rondure
