// A ray and an analytic ellipsoid, in intervals: a quadratic whose every coefficient is an enclosure.
#pragma once

#include "renderer/intersect/certified_ray.h"
#include "renderer/intersect/enclosure.h"

namespace rondure {

template <class T>
struct EllipsoidRoots {
  bool may_meet = false, meets = false;  // at all; certainly
  Enclosure<T> s[2];                     // entering, leaving
};

// The image of the unit sphere under `map`. Multiplied by its adjugate, a point p of the ray is on it where
// |adj p| = |det|. That is of the third degree in the map: lengths are taken in units of its size.
template <class T>
EllipsoidRoots<T> certified_ellipsoid(const dmat3& map, const CertifiedRay<T>& ray) {
  using E = Enclosure<T>;
  const int size = std::ilogb(std::max({largest(map[0]), largest(map[1]), largest(map[2])}));
  const auto unit = [&](double x) { return ldexp(E{static_cast<T>(x), static_cast<T>(x)}, -size); };
  // Row i of the adjugate is the cross product of the two other columns.
  E row[3][3];
  for (int i = 0; i < 3; ++i) {
    const dvec3 &p = map[(i + 1) % 3], &q = map[(i + 2) % 3];
    for (int k = 0; k < 3; ++k)
      row[i][k] = unit(p[(k + 1) % 3]) * unit(q[(k + 2) % 3]) - unit(p[(k + 2) % 3]) * unit(q[(k + 1) % 3]);
  }
  const auto times = [&](int i, const E* x) {
    return row[i][0] * x[0] + row[i][1] * x[1] + row[i][2] * x[2];
  };
  E base[3], direction[3], column[3];
  for (int k = 0; k < 3; ++k) {
    base[k] = ldexp(E::about(ray.base()[k], ray.base_error()), -size);
    direction[k] = {ray.direction()[k], ray.direction()[k]};
    column[k] = unit(map[0][k]);
  }
  const E det = times(0, column);
  E a{}, b{}, c{};
  for (int i = 0; i < 3; ++i) {
    const E x = times(i, direction), y = times(i, base);
    a = a + x * x, b = b + x * y, c = c + y * y;
  }
  const E discriminant = b * b - a * (c - det * det);
  EllipsoidRoots<T> out;
  if (!(a.low > 0)) return {true, false, {E::everything(), E::everything()}};
  out.may_meet = !(discriminant.high < 0), out.meets = discriminant.low > 0;
  if (!out.may_meet) return out;
  const E root = sqrt(discriminant), zero{};
  out.s[0] = ldexp((zero - b - root) / a, size), out.s[1] = ldexp((root - b) / a, size);
  return out;
}

}  // namespace rondure
