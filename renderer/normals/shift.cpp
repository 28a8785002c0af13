#include "renderer/bezier/rational.h"
#include "renderer/normals/direction.h"
#include "renderer/normals/estimator.h"

namespace rondure {

NormalEstimate shift_normal(const Net& net, double u, double v) {
  const SurfaceJet s = surface_jet(net, u, v);
  if (!nearly_parallel(s.du, s.dv, parallel_tangents)) return direction_of(glm::cross(s.du, s.dv));
  const dvec2 middle = std::holds_alternative<TensorNet>(net) ? dvec2(0.5, 0.5) : dvec2(1.0 / 3.0, 1.0 / 3.0);
  const dvec2 at = dvec2(u, v) + shift_offset * (middle - dvec2(u, v));
  return cross_normal(net, at.x, at.y);
}

}  // namespace rondure
