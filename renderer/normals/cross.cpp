#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/normals/direction.h"
#include "renderer/normals/estimator.h"

namespace rondure {

NormalEstimate cross_normal(const Net& net, double u, double v) {
  const SurfaceJet s = surface_jet(net, u, v);
  return direction_of(glm::cross(s.du, s.dv));
}

}  // namespace rondure
