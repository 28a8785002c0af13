#include "renderer/bezier/rational.h"
#include "renderer/normals/direction.h"
#include "renderer/normals/estimator.h"
#include "renderer/normals/normal_germ.h"

namespace rondure {

NormalEstimate limit_normal(const Net& net, double u, double v) {
  const NormalEstimate limit = direction_of(unit_normal(net, u, v));
  if (!limit) return {};
  // Only at a singular point itself can there be more than one limit; a little off, rounding has long told
  // the tangents apart.
  const SurfaceJet s = surface_jet(net, u, v);
  if (!nearly_parallel(s.du, s.dv, 1e-14)) return limit;
  return germ_of(net, {u, v}).has_limit ? limit : std::nullopt;
}

}  // namespace rondure
