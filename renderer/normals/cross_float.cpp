#include "renderer/bezier/tangents_in.h"
#include "renderer/normals/direction.h"
#include "renderer/normals/estimator.h"

namespace rondure {

NormalEstimate cross_float_normal(const Net& net, double u, double v) {
  const TangentsIn<float> t = tangents_in<float>(net, static_cast<float>(u), static_cast<float>(v));
  const Vector3In<float> n = cross_in(t.du, t.dv);
  const float square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  if (!(square > 0.0f) || !std::isfinite(square)) return {};
  const float length = std::sqrt(square);
  // A float's unit vector is not one in double.
  return direction_of(dvec3(n[0] / length, n[1] / length, n[2] / length));
}

}  // namespace rondure
