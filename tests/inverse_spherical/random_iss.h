// Random inverse spherical surfaces for the tests.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/inverse_spherical/iss.h"
#include "renderer/inverse_spherical/spherical_triangle.h"
#include "tests/bezier/random_nets.h"

namespace rondure {

// Three unit vectors, anticlockwise, with a determinant of at least 0.2.
inline std::array<dvec3, 3> random_triangle(NetMaker& make) {
  for (;;) {
    std::array<dvec3, 3> t;
    for (dvec3& p : t) {
      const double z = make.uniform(-1.0, 1.0), angle = make.uniform(0.0, 6.28318530717958648);
      p = dvec3(std::sqrt(1.0 - z * z) * std::cos(angle), std::sqrt(1.0 - z * z) * std::sin(angle), z);
      p = glm::normalize(p);
    }
    if (orientation(t[0], t[1], t[2]) > 0.2) return t;
  }
}

// Moduli in [0.4, 2.5], coefficients in [0.5, 2].
inline PlanarIss random_planar_iss(NetMaker& make, int n) {
  std::array<dvec3, 3> t = random_triangle(make);
  for (dvec3& p : t) p *= make.uniform(0.4, 2.5);
  std::vector<double> c(static_cast<std::size_t>(triangle_size(n)));
  for (double& x : c) x = make.uniform(0.5, 2.0);
  return planar_iss(n, t, c);
}

// A planar domain whose vectors were stretched by factors in [0.9, 1.1] each: no longer planar.
inline Iss random_general_iss(NetMaker& make, int n) {
  Iss s = general_form(random_planar_iss(make, n));
  for (dvec3& u : s.u) u *= make.uniform(0.9, 1.1);
  return s;
}

}  // namespace rondure
