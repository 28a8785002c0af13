// A net seen along a ray: two scalar Bernstein polynomials whose common zeros are the ray's hits.
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "renderer/intersect/local_ray.h"

namespace rondure {

// (plane0 . S, plane1 . S) of one homogeneous point.
inline dvec2 project(const LocalRay& ray, const dvec4& s) {
  const dvec4 &p = ray.plane[0], &q = ray.plane[1];
  return dvec2((p.x * s.x + p.y * s.y) + (p.z * s.z + p.w * s.w),
               (q.x * s.x + q.y * s.y) + (q.z * s.z + q.w * s.w));
}

// out[k] = (plane0 . P_k, plane1 . P_k). No division: at a zero of both, S(u, v) is on both planes, weights
// included.
inline void project_net(std::span<const dvec4> points, const LocalRay& ray, dvec2* out) {
  for (std::size_t k = 0; k < points.size(); ++k) out[k] = project(ray, points[k]);
}

}  // namespace rondure
