// Where a ray with double coordinates meets a sphere, in quadruple precision: 113 bits, so that even from
// 10^8 radii away the impact parameter is good to 10^-17 of a radius.
#pragma once

#include <cmath>

#include "renderer/intersect/ray.h"

namespace rondure {

struct SphereReference {
  double clearance;  // impact parameter / radius - 1: negative when the line meets the sphere
  double t[2];       // entry and exit, when it does
  double cosine;     // of the angle of incidence
};

inline SphereReference sphere_reference(const dvec3& origin, const dvec3& direction, const dvec3& center,
                                        double radius) {
  using Quad = __float128;
  Quad d[3], q[3], dd = 0, qd = 0;
  for (int k = 0; k < 3; ++k) {
    d[k] = direction[k];
    q[k] = static_cast<Quad>(center[k]) - static_cast<Quad>(origin[k]);
    dd += d[k] * d[k];
    qd += q[k] * d[k];
  }
  const Quad middle = qd / dd;
  Quad impact2 = 0;
  for (int k = 0; k < 3; ++k) impact2 += (q[k] - middle * d[k]) * (q[k] - middle * d[k]);
  const Quad r2 = static_cast<Quad>(radius) * static_cast<Quad>(radius);
  SphereReference out{};
  out.clearance = std::sqrt(static_cast<double>(impact2 / r2)) - 1.0;
  // Near tangency the square root's rounding is too coarse; (b^2 - r^2) / (r^2 (b / r + 1)) is exact to an
  // ulp of itself.
  if (std::fabs(out.clearance) < 1e-3)
    out.clearance = static_cast<double>((impact2 - r2) / r2) / (2.0 + out.clearance);
  if (impact2 < r2) {
    const double half = std::sqrt(static_cast<double>((r2 - impact2) / dd));
    for (int k = 0; k < 2; ++k) {
      const Quad t = middle + static_cast<Quad>(k == 0 ? -half : half);
      out.t[k] = static_cast<double>(t);
    }
    out.cosine = std::sqrt(static_cast<double>((r2 - impact2) / r2));
  }
  return out;
}

}  // namespace rondure
