// Where lines meet quadrics, by their equations alone.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/intersect/tracer.h"
#include "renderer/projective/quadric.h"

namespace rondure {

struct Meeting {
  int count = 0;
  double t[2] = {0, 0};
};

// Where the line meets x^T B x = 0, from the quadratic equation in extended precision.
inline Meeting meet(const lmat4& matrix, const Ray& ray) {
  const lvec4 o(lvec3(ray.origin), 1), d(lvec3(ray.direction), 0);
  const long double a = glm::dot(d, matrix * d), b = glm::dot(o, matrix * d), c = glm::dot(o, matrix * o);
  Meeting found;
  const long double root2 = b * b - a * c;
  if (root2 < 0) return found;
  const long double q = -(b + (b < 0 ? -1 : 1) * std::sqrt(root2));
  for (const long double t : {a != 0 ? q / a : INFINITY, c / q}) {
    if (std::isfinite(t)) found.t[found.count++] = static_cast<double>(t);
  }
  return found;
}

}  // namespace rondure
