// Exterior products of homogeneous points (wx, wy, wz, w): lines, planes and determinants, as the bilinear
// maps that `multiply` takes.
#pragma once

#include <glm/geometric.hpp>

#include "renderer/api/patch.h"

namespace rondure {

// The line through two homogeneous points, in Pluecker coordinates.
struct Line {
  dvec3 moment{0.0}, direction{0.0};

  Line() = default;
  explicit Line(double) {}
  Line(const dvec3& m, const dvec3& d) : moment(m), direction(d) {}
  Line& operator+=(const Line& o) {
    moment += o.moment;
    direction += o.direction;
    return *this;
  }
  Line& operator*=(double s) {
    moment *= s;
    direction *= s;
    return *this;
  }
  Line& operator/=(double s) {
    moment /= s;
    direction /= s;
    return *this;
  }
};

inline Line join(const dvec4& g, const dvec4& h) {
  return {glm::cross(dvec3(g), dvec3(h)), h.w * dvec3(g) - g.w * dvec3(h)};
}

// Normal part of the plane through a point and a line: F_w (G x H) + G_w (H x F) + H_w (F x G).
inline dvec3 join_plane(const dvec4& f, const Line& gh) {
  return f.w * gh.moment + glm::cross(dvec3(f), gh.direction);
}

// det(F, G, H, K), w last: minus the plane through F, G and H (of normal join_plane) applied to K.
inline double join_lines(const Line& fg, const Line& hk) {
  return glm::dot(fg.moment, hk.direction) + glm::dot(fg.direction, hk.moment);
}

}  // namespace rondure
