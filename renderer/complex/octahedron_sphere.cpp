#include "renderer/complex/octahedron_sphere.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rondure {
namespace {

using Real = long double;
using Point = std::array<Real, 4>;  // x, y, z for i >= j >= k, and the weight

// a + b sqrt 2 + c sqrt 3 + d sqrt 6.
Real number(Real a, Real b, Real c, Real d) {
  return a + b * std::sqrt(2.0L) + c * std::sqrt(3.0L) + d * std::sqrt(6.0L);
}

// For exponents i >= j >= k with i + j + k = 6.
Point sorted_point(int i, int j) {
  if (i == 6) return {1, 0, 0, 1};
  if (i == 5) return {1, number(3, 4, 7, -6) / 23, 0, number(4, 3, 0, 1) / 12};
  if (i == 4 && j == 2)
    return {number(15, 3, 11, -7) / 23, number(-29, 31, 14, -11) / 23, 0, number(4, 3, 1, 1) / 15};
  if (i == 4) {
    const Real g = number(-11, -9, 7, 5) / 2;
    return {1, g, g, number(3, 2, 2, 1) / 15};
  }
  if (i == 3 && j == 3) {
    const Real g = number(0, 3, 3, -2) / 6;
    return {g, g, 0, number(6, 3, 2, 1) / 20};
  }
  if (i == 3)
    return {number(352, 214, -36, -35) / 577, number(501, -138, 34, 1) / 577,
            number(-295, 178, 299, -110) / 577, number(18, 13, 14, 11) / 120};
  const Real g = number(40416, 17364, -4835, -4644) / 66669;
  return {g, g, g, number(33, 12, 21, 16) / 180};
}

}  // namespace

std::vector<TriangleNet> octahedron_sphere() {
  std::vector<TriangleNet> nets;
  for (int octant = 0; octant < 8; ++octant) {
    TriangleNet net(6);
    for (int i = 0; i <= 6; ++i) {
      for (int j = 0; j <= 6 - i; ++j) {
        const std::array<int, 3> e{i, j, 6 - i - j};
        // The octant is symmetric in its axes: the axis with the k-th largest exponent has coordinate k.
        std::array<std::size_t, 3> axes{0, 1, 2};
        std::stable_sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) { return e[a] > e[b]; });
        const Point p = sorted_point(e[axes[0]], e[axes[1]]);
        dvec4& out = net.at(i, j);
        for (std::size_t k = 0; k < 3; ++k) {
          const int axis = static_cast<int>(axes[k]);
          const bool mirrored = (octant >> (2 - axis) & 1) != 0;
          out[axis] = static_cast<double>((mirrored ? -p[3] : p[3]) * p[k]);
        }
        out.w = static_cast<double>(p[3]);
      }
    }
    nets.push_back(std::move(net));
  }
  return nets;
}

}  // namespace rondure
