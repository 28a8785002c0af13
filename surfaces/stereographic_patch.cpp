#include "surfaces/stereographic_patch.h"

#include <algorithm>
#include <cmath>

#include "renderer/projective/stereographic.h"

namespace rondure {
namespace {

using Polynomial = TensorPolynomial<long double>;

Polynomial polynomial(const long double (&c)[3][3]) {
  Polynomial p(2, 2);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) p.at(i, j) = c[i][j];
  }
  return p;
}

}  // namespace

PlanarBiquadratic disk(long double radius, long double middle_weight) {
  const long double r = radius;
  const long double h = 0.7071067811865475244008443621048490393L;
  const long double c = middle_weight;
  return {{{r, h * r, 0}, {h * r, 0, -h * r}, {0, -h * r, -r}},
          {{0, h * r, r}, {-h * r, 0, h * r}, {-r, -h * r, 0}},
          {{1, h, 1}, {h, c, h}, {1, h, 1}}};
}

TensorNet sphere_patch(const PlanarBiquadratic& planar, long double scale) {
  const PlanarMap<Polynomial> map{polynomial(planar.x), polynomial(planar.y), polynomial(planar.w)};
  const std::array<Polynomial, 4> sphere = to_sphere(map);
  long double largest = 0;
  for (const Polynomial& p : sphere) {
    for (const long double c : p.coefficients) largest = std::max(largest, std::abs(c));
  }
  TensorNet net(4, 4);
  for (std::size_t k = 0; k < net.points.size(); ++k) {
    for (int d = 0; d < 4; ++d) {
      const long double c = sphere[static_cast<std::size_t>(d)].coefficients[k];
      // What is left of a sum that vanishes exactly: some units of the last of the 64 bits.
      const bool vanishes = std::abs(c) < 0x1p-58L * largest;
      net.points[k][d] = vanishes ? 0.0 : static_cast<double>(scale * c);
    }
  }
  return net;
}

}  // namespace rondure
