// The generalised stereographic projection delta of projective 3-space onto the unit sphere (Dietz, Hoschek,
// Juettler 1993, section 3), and the maps that it is made of.
//
// Points and planes of projective space are written as in the paper, (p0, p1, p2, p3) with p0 first. Points
// of the sphere are homogeneous, (x, y, z, w) with w last, as everywhere else.
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "renderer/projective/extended.h"

namespace rondure {

using lvec4 = glm::vec<4, long double, glm::defaultp>;
using lmat4 = glm::mat<4, 4, long double, glm::defaultp>;

// The symmetric bilinear form of delta: delta(p) = delta(p, p), equation (20).
inline lvec4 delta(const lvec4& p, const lvec4& q) {
  return {p[0] * q[1] + p[1] * q[0] - p[2] * q[3] - p[3] * q[2],
          p[1] * q[3] + p[3] * q[1] + p[0] * q[2] + p[2] * q[0],
          p[1] * q[1] + p[2] * q[2] - p[0] * q[0] - p[3] * q[3],
          p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3]};
}
inline lvec4 delta(const lvec4& p) { return delta(p, p); }

// Stereographic projection from (0, 0, 1) of the plane p3 = 0 onto the sphere, its inverse, and the
// hyperbolic projection, equations (21), (22), (23). delta = sigma o theta.
inline lvec4 sigma(const lvec4& p) {
  const long double r = p[1] * p[1] + p[2] * p[2];
  return {2 * p[0] * p[1], 2 * p[0] * p[2], r - p[0] * p[0], r + p[0] * p[0]};
}
inline lvec4 sigma_inverse(const lvec4& x) { return {x.w - x.z, x.x, x.y, 0}; }
inline lvec4 theta(const lvec4& p) {
  return {p[0] * p[0] + p[3] * p[3], p[0] * p[1] - p[2] * p[3], p[1] * p[3] + p[0] * p[2], 0};
}

// The point p' of the projecting line through p with which it makes a basis of that line (24), and the plane
// that contains it. p, perp(p), bar(p), perp(bar(p)) are orthogonal.
inline lvec4 perp(const lvec4& p) { return {-p[3], p[2], -p[1], p[0]}; }
inline lvec4 bar(const lvec4& p) { return {p[2], p[3], -p[0], -p[1]}; }

// Where the projecting line of p meets a plane that does not contain it (lemma 3.7).
inline lvec4 meet_plane(const lvec4& p, const lvec4& plane) {
  return glm::dot(plane, p) * perp(p) - glm::dot(plane, perp(p)) * p;
}

// The plane through the point p and the projecting line of r, which must not contain p (lemma 3.8).
inline lvec4 plane_through(const lvec4& p, const lvec4& r) {
  return glm::dot(p, bar(r)) * perp(bar(r)) - glm::dot(p, perp(bar(r))) * bar(r);
}

// Pluecker coordinates (3) of the line through two points: g01, g02, g03, g23, g31, g12.
inline std::array<long double, 6> pluecker(const lvec4& x, const lvec4& y) {
  const auto g = [&](int i, int j) { return x[i] * y[j] - x[j] * y[i]; };
  return {g(0, 1), g(0, 2), g(0, 3), g(2, 3), g(3, 1), g(1, 2)};
}

// The quadric p^T M p = 0 of all points that delta takes to the plane h . (x, y, z, w) = 0 (lemma 3.4): a
// ruled one when the plane cuts the sphere in a circle.
inline lmat4 preimage_of_plane(const lvec4& h) {
  lmat4 m(0);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      lvec4 p(0), q(0);
      p[i] = q[j] = 1;
      m[i][j] = glm::dot(h, delta(p, q));
    }
  }
  return m;
}

}  // namespace rondure
