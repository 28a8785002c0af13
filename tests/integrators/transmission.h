// What Fresnel says of the light that crosses a smooth interface: what he says of the rest is under test.
#pragma once

#include <algorithm>
#include <cmath>

namespace rondure {

// Light through an interface of two media by Fresnel's transmission coefficients (Born and Wolf, section
// 1.5.2), where the renderer has those of reflection. `eta`: far over near.
struct Transmission {
  double share = 0.0, error = 0.0;
};
inline Transmission transmission(double cosine, double eta) {
  constexpr double u = 0x1p-53;
  using Extended = long double;
  const Extended c = cosine, e = eta, far2 = 1 - (1 - c * c) / (e * e);
  // The renderer's own squared cosine on the far side is wrong by a roundoff of c^2, the four roundings of
  // (1 - c^2) / eta^2 and one more, the cosine by that over twice itself or at most the square root, and both
  // amplitudes by no more than their slopes times that, and some ten roundings of theirs.
  const double far_error = u * static_cast<double>((1 + 4 * (1 - c * c)) / (e * e)) + u;
  if (!(far2 > 0)) return {0.0, far2 > -far_error ? 8.0 * std::sqrt(far_error) * eta / cosine : u};
  // e far / c (s^2 + p^2) / 2 of the amplitudes s = 2 c / (c + e far) and p = 2 c / (e c + far); c may be 0.
  const Extended far = std::sqrt(far2), s = 1 / (c + e * far), p = 1 / (e * c + far);
  const double f = static_cast<double>(far), moved = std::min(far_error / f, std::sqrt(far_error));
  const double slope_s = 2.0 * cosine * eta / ((cosine + eta * f) * (cosine + eta * f)),
               slope_p = 2.0 * cosine * eta / ((eta * cosine + f) * (eta * cosine + f));
  return {static_cast<double>(2 * e * far * c * (s * s + p * p)),
          2.0 * (slope_s + slope_p) * moved + 20.0 * u};
}

}  // namespace rondure
