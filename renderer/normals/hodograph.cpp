#include "renderer/normals/direction.h"
#include "renderer/normals/estimator.h"

namespace rondure {

NormalEstimate hodograph_normal(const ReducedNormal& reduced, double u, double v) {
  return direction_of(polynomial_value(reduced.direction, u, v));
}

}  // namespace rondure
