// A net seen along a ray: two scalar Bernstein polynomials whose common zeros are the ray's hits.
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "renderer/intersect/local_ray.h"

namespace rondure {

// out[k] = (plane0 . P_k, plane1 . P_k). No division: at a zero of both, S(u, v) is on both planes, weights included.
inline void project_net(std::span<const dvec4> points, const LocalRay& ray, dvec2* out) {
  const dvec4 &a = ray.plane[0], &b = ray.plane[1];
  for (std::size_t k = 0; k < points.size(); ++k) {
    const dvec4& p = points[k];
    out[k] = dvec2((a.x * p.x + a.y * p.y) + (a.z * p.z + a.w * p.w), (b.x * p.x + b.y * p.y) + (b.z * p.z + b.w * p.w));
  }
}

}  // namespace rondure
