#include "renderer/projective/planar_patch.h"

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

std::array<Polynomial, 4> composed(const PlanarBiquadratic& planar) {
  return to_sphere(PlanarMap<Polynomial>{polynomial(planar.x), polynomial(planar.y), polynomial(planar.w)});
}

// `place` turns the points to where they belong.
template <class Place>
TensorNet rounded_net(const std::array<Polynomial, 4>& sphere, long double scale, const Place& place) {
  long double largest = 0;
  for (const Polynomial& p : sphere) {
    for (const long double c : p.coefficients) largest = std::max(largest, std::abs(c));
  }
  TensorNet net(sphere[0].m, sphere[0].n);
  for (std::size_t k = 0; k < net.points.size(); ++k) {
    const lvec3 x =
        place(lvec3(sphere[0].coefficients[k], sphere[1].coefficients[k], sphere[2].coefficients[k]));
    const long double c[4] = {x.x, x.y, x.z, sphere[3].coefficients[k]};
    for (int d = 0; d < 4; ++d) {
      // What is left of a sum that vanishes exactly: some units of the last of the 64 bits.
      const bool vanishes = std::abs(c[d]) < 0x1p-58L * largest;
      net.points[k][d] = vanishes ? 0.0 : static_cast<double>(scale * c[d]);
    }
  }
  return net;
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

PlanarBiquadratic cube_square(long double middle_weight) {
  const long double r2 = 1.414213562373095048801688724209698079L;
  const long double r3 = 1.732050807568877293527446341505872367L;
  const long double a = r3 - 1;
  const long double e = (3 - r3) * r2 / 2;
  const long double w = (r3 + 1) * r2 / 4;
  const long double c = middle_weight;
  return {{{-a, 0, a}, {-e, 0, e}, {-a, 0, a}},
          {{-a, -e, -a}, {0, 0, 0}, {a, e, a}},
          {{1, w, 1}, {w, c, w}, {1, w, 1}}};
}

TensorNet sphere_patch(const PlanarBiquadratic& planar, long double scale) {
  const auto sphere = composed(planar);
  return rounded_net(sphere, scale, [](const lvec3& p) { return p; });
}

TensorNet sphere_patch(const PlanarBiquadratic& planar, const Frame& frame) {
  const auto sphere = composed(planar);
  return rounded_net(sphere, 1,
                     [&](const lvec3& p) { return frame.e1 * p.x + frame.e2 * p.y - frame.centre * p.z; });
}

}  // namespace rondure
