// The rays of the benchmarks: the same doubles for everybody, rounded to float for those that trace in float.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "renderer/intersect/ray.h"

namespace rondure::bench {

// Camera rays in scan-line order, at a unit sphere that fills three quarters of the picture.
inline std::vector<Ray> coherent_rays(int side) {
  std::vector<Ray> rays;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double sx = 2.0 * (x + 0.5) / side - 1.0, sy = 2.0 * (y + 0.5) / side - 1.0;
      rays.push_back({dvec3(0.3, -4.0, 0.5),
                      glm::normalize(dvec3(0.27 * sx, 1.0, 0.27 * sy) - dvec3(0.075, 0.0, 0.125))});
    }
  return rays;
}

// From random points outside towards random points of the ball: all hit, in no order.
inline std::vector<Ray> incoherent_rays(int count) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Ray> rays;
  for (int k = 0; k < count; ++k) {
    const double a = normal(random), b = normal(random), c = normal(random), d = normal(random),
                 e = normal(random), f = normal(random);
    const dvec3 origin = 3.0 * glm::normalize(dvec3(a, b, c)),
                target = std::cbrt(uniform(random)) * glm::normalize(dvec3(d, e, f));
    rays.push_back({origin, glm::normalize(target - origin)});
  }
  return rays;
}

}  // namespace rondure::bench
