// The ray as the exact numbers that its doubles are.
#pragma once

#include "renderer/intersect/ray.h"
#include "tests/oracle/polynomial_pair.h"

namespace rondure::oracle {

using Real3 = std::array<Real, 3>;

inline Real dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Real3 cross(const Real3& a, const Real3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Real3 scaled(const Real& s, const Real3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Real3 unit(const Real3& a) { return scaled(1 / sqrt(dot(a, a)), a); }
inline double rounded(const Real& x) { return x.convert_to<double>(); }

// The ray in the surface's frame, and two unit normals across it.
struct Line {
  Real3 origin, direction, normal[2];
};

inline Line line_of(const Ray& ray, const dvec3& frame) {
  Line out;
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    out.origin[at] = Real(ray.origin[k]) - Real(frame[k]);
    out.direction[at] = ray.direction[k];
  }
  // Without the direction's largest component the other two would be the normal's rounding.
  std::size_t big = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (abs(out.direction[k]) > abs(out.direction[big])) big = k;
  Real3 axis{0, 0, 0};
  axis[(big + 1) % 3] = 1;
  out.normal[0] = unit(cross(axis, out.direction));
  out.normal[1] = unit(cross(out.direction, out.normal[0]));
  return out;
}

}  // namespace rondure::oracle
