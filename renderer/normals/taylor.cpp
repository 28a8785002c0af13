#include "renderer/bezier/rational.h"
#include "renderer/normals/direction.h"
#include "renderer/normals/estimator.h"

namespace rondure {

NormalEstimate taylor_normal(const Net& net, double u, double v) {
  const SurfaceJet s = surface_jet(net, u, v);
  const dvec3 n = glm::cross(s.du, s.dv);
  if (!nearly_parallel(s.du, s.dv, parallel_tangents)) return direction_of(n);
  const dvec3 along_u = glm::cross(s.duu, s.dv) + glm::cross(s.du, s.duv);
  const dvec3 along_v = glm::cross(s.duv, s.dv) + glm::cross(s.du, s.dvv);
  // Inward: toward the middle of the square, or away from the far side of the triangle.
  double in_u = u > 0.5 ? -1.0 : 1.0, in_v = v > 0.5 ? -1.0 : 1.0;
  if (std::holds_alternative<TriangleNet>(net) && u + v > 1.0 - parallel_tangents) {
    if (u > 0.0 && v > 0.0) in_u = in_v = -1.0;
  }
  return direction_of(in_u * along_u + in_v * along_v);
}

}  // namespace rondure
