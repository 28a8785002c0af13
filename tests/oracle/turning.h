// Where the gradients of a pair of polynomials are parallel: there the ray touches the patch, or all but
// touches it.
#pragma once

#include "tests/oracle/polynomial_pair.h"

namespace rondure::oracle {

// Combines the two planes so that the first polynomial has all of the gradient that it can have.
inline void rotate(Jet& s) {
  const Real gg = s.da[0] * s.da[0] + s.db[0] * s.db[0], hh = s.da[1] * s.da[1] + s.db[1] * s.db[1],
             gh = s.da[0] * s.da[1] + s.db[0] * s.db[1];
  const Real angle = atan2(2 * gh, gg - hh) / 2, c = cos(angle), d = sin(angle);
  for (Real2* x : {&s.value, &s.da, &s.db, &s.daa, &s.dab, &s.dbb})
    *x = {c * (*x)[0] + d * (*x)[1], c * (*x)[1] - d * (*x)[0]};
}

// Where the gradients are parallel: along the zeros of one polynomial f, the other, g, is stationary where
// the Jacobian determinant J vanishes, and that changes at the rate f_b J_a - f_a J_b.
struct Turn {
  Real slope2, rate, scale;
};
inline Turn turn(const Jet& s) {
  const Real ja = s.daa[0] * s.db[1] + s.da[0] * s.dab[1] - s.dab[0] * s.da[1] - s.db[0] * s.daa[1],
             jb = s.dab[0] * s.db[1] + s.da[0] * s.dbb[1] - s.dbb[0] * s.da[1] - s.db[0] * s.dab[1];
  const Real slope2 = s.da[0] * s.da[0] + s.db[0] * s.db[0];
  const Real bend = std::max({size_of(s.daa), size_of(s.dab), size_of(s.dbb)});
  return {slope2, s.db[0] * ja - s.da[0] * jb, slope2 * bend};
}

}  // namespace rondure::oracle
