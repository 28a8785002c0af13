#include "renderer/projective/planar_patch.h"

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

Polynomial magnitudes(Polynomial p) {
  for (long double& c : p.coefficients) c = std::abs(c);
  return p;
}

// `scale` times the composition, its points turned by the columns of `turn`.
TensorNet composed(const PlanarBiquadratic& planar, long double scale, const lvec3 (&turn)[3]) {
  const Polynomial x = polynomial(planar.x), y = polynomial(planar.y), w = polynomial(planar.w);
  const auto sphere = to_sphere(PlanarMap<Polynomial>{x, y, w});
  // The same sums without signs; the last bounds that of z, too.
  const auto sizes = to_sphere(PlanarMap<Polynomial>{magnitudes(x), magnitudes(y), magnitudes(w)});
  TensorNet net(sphere[0].m, sphere[0].n);
  for (std::size_t k = 0; k < net.points.size(); ++k) {
    const auto at = [&](const std::array<Polynomial, 4>& p, std::size_t d) { return p[d].coefficients[k]; };
    const auto put = [&](int d, long double value, long double size) {
      // What is left of a sum that vanishes exactly: some units of the last of the 64 bits of its terms.
      net.points[k][d] = std::abs(value) <= 0x1p-58L * size ? 0.0 : static_cast<double>(scale * value);
    };
    for (int d = 0; d < 3; ++d) {
      put(d, turn[0][d] * at(sphere, 0) + turn[1][d] * at(sphere, 1) + turn[2][d] * at(sphere, 2),
          std::abs(turn[0][d]) * at(sizes, 0) + std::abs(turn[1][d]) * at(sizes, 1) +
              std::abs(turn[2][d]) * at(sizes, 3));
    }
    put(3, at(sphere, 3), at(sizes, 3));
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
  return composed(planar, scale, {lvec3(1, 0, 0), lvec3(0, 1, 0), lvec3(0, 0, 1)});
}

TensorNet sphere_patch(const PlanarBiquadratic& planar, const StereographicFrame& frame) {
  return composed(planar, 1, {frame.e1, frame.e2, -frame.centre});
}

}  // namespace rondure
