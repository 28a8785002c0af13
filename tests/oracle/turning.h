// Where the gradients of a pair of polynomials are parallel: there the ray touches the patch, or all but
// touches it.
#pragma once

#include "tests/oracle/polynomial_pair.h"

namespace rondure::oracle {

// By which angle the two planes are to be combined for the first polynomial to have all of the gradient that
// it can have.
inline Real rotation(const Jet& s) {
  const Real gg = s.da[0] * s.da[0] + s.db[0] * s.db[0], hh = s.da[1] * s.da[1] + s.db[1] * s.db[1],
             gh = s.da[0] * s.da[1] + s.db[0] * s.db[1];
  return atan2(2 * gh, gg - hh) / 2;
}

// Where the gradients are parallel: along the zeros of the first polynomial f the second, g, is stationary
// where the Jacobian determinant J vanishes, and that changes at the rate f_b J_a - f_a J_b.
inline void rotate(Jet& s) {
  const Real angle = rotation(s), c = cos(angle), d = sin(angle);
  for (Real2* x : {&s.value, &s.da, &s.db, &s.daa, &s.dab, &s.dbb})
    *x = {c * (*x)[0] + d * (*x)[1], c * (*x)[1] - d * (*x)[0]};
}

}  // namespace rondure::oracle
