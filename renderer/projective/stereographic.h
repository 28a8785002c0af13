// The inverse of stereographic projection from the north pole of the unit sphere to the plane that touches it
// at the south pole, on planar rational patches (Cobb 1988, section 3).
#pragma once

#include <array>

#include "renderer/bezier/compose.h"

namespace rondure {

// s(X, Y, W) = (4XW, 4YW, X^2 + Y^2 - 4W^2, X^2 + Y^2 + 4W^2), as four polynomials of twice the degree: x, y,
// z, w. Composed from products: written as a (2,2) patch, s would bring in a common factor W^2.
template <class Polynomial>
std::array<Polynomial, 4> to_sphere(const PlanarMap<Polynomial>& g) {
  const Polynomial xw = multiply(g.x, g.w);
  const Polynomial yw = multiply(g.y, g.w);
  const Polynomial ww = multiply(g.w, g.w);
  const Polynomial rr = add_scaled(multiply(g.x, g.x), multiply(g.y, g.y), 1);
  return {add_scaled(xw, xw, 3), add_scaled(yw, yw, 3), add_scaled(rr, ww, -4), add_scaled(rr, ww, 4)};
}

}  // namespace rondure
