// The quadrics on which the studies' subjects lie, as their families define them, and curvatures by formulas
// other than the renderer's.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "renderer/api/patch.h"

namespace rondure {

// The sum of d_i x_i^2 is 1; or, where d_z = 0 on a paraboloid, that of d_x x^2 + d_y y^2 is z / height.
struct SubjectQuadric {
  std::array<double, 3> d{1.0, 1.0, 1.0};
  double height = 0.0;

  template <class T>
  std::array<T, 3> gradient(const std::array<T, 3>& x) const {
    std::array<T, 3> g;
    for (std::size_t k = 0; k < 3; ++k) g[k] = 2 * T(d[k]) * x[k];
    if (height != 0.0) g[2] -= 1 / T(height);
    return g;
  }

  // At a point of it, with the mean curvature's sign for the normal along the gradient: for central quadrics
  // d_x d_y d_z / |D x|^4 and -d_x d_y d_z (1/d_x + 1/d_y + 1/d_z - |x|^2) / (2 |D x|^3); for the paraboloids
  // Monge's formulas, seen from below.
  double gaussian(const dvec3& p) const;
  double mean(const dvec3& p) const;
};

inline double SubjectQuadric::gaussian(const dvec3& p) const {
  if (height != 0.0) {
    const double hx = 2.0 * height * d[0] * p.x, hy = 2.0 * height * d[1] * p.y, w = 1.0 + hx * hx + hy * hy;
    return 4.0 * height * height * d[0] * d[1] / (w * w);
  }
  const double square = std::pow(d[0] * p.x, 2) + std::pow(d[1] * p.y, 2) + std::pow(d[2] * p.z, 2);
  return d[0] * d[1] * d[2] / (square * square);
}

inline double SubjectQuadric::mean(const dvec3& p) const {
  if (height != 0.0) {
    const double hx = 2.0 * height * d[0] * p.x, hy = 2.0 * height * d[1] * p.y, w = 1.0 + hx * hx + hy * hy;
    return -height * ((1.0 + hx * hx) * d[1] + (1.0 + hy * hy) * d[0]) / std::pow(w, 1.5);
  }
  const double square = std::pow(d[0] * p.x, 2) + std::pow(d[1] * p.y, 2) + std::pow(d[2] * p.z, 2);
  const double inverses = 1.0 / d[0] + 1.0 / d[1] + 1.0 / d[2], size = p.x * p.x + p.y * p.y + p.z * p.z;
  return -d[0] * d[1] * d[2] * (inverses - size) / (2.0 * std::pow(square, 1.5));
}

// Empty for cones and for what lies on no quadric.
inline std::optional<SubjectQuadric> subject_quadric(const std::string& name) {
  const double a = 1.0, b = 1.0 / (0.8 * 0.8), c = 1.0 / (0.6 * 0.6);
  if (name.starts_with("ellipsoid")) return SubjectQuadric{{a, b, c}};
  if (name == "two_sheets") return SubjectQuadric{{-a, -b, c}};
  if (name == "one_sheet") return SubjectQuadric{{a, b, -c}};
  if (name == "elliptic_paraboloid") return SubjectQuadric{{a, b, 0.0}, 0.6};
  if (name == "hyperbolic_paraboloid") return SubjectQuadric{{a, -b, 0.0}, 0.6};
  if (name.starts_with("iss") || name.starts_with("cone") || name == "cross_caps") return {};
  if (name.starts_with("gc") && name != "gc1_sphere") return {};
  return SubjectQuadric{};
}

}  // namespace rondure
