// Proof in integers that the normal of a patch vanishes somewhere.
#pragma once

#include <optional>

#include "renderer/continuity/exact_normal.h"

namespace rondure {

// Half the side of a square about (u, v) in which the normal has a zero of the patch's domain; 0 where (u, v)
// itself is one. Nothing where that is not proved.
//
// Multiples of 2^-20 and fractions of 1000 parts at most that lie nearby are looked at too: a zero on a side,
// or one that is no crossing of two curves, is proved at such places only.
//
// Where a derivative S_a has a coordinate x that is not 0, two coordinates of N = w^3 S_u x S_v that have
// S_a's x in both their terms vanish only together with the third. That they do somewhere in the square is
// told by Miranda's theorem (1940): after a linear map each of them has one sign on one side and the other on
// the opposite one. `most_squares` squares of 2^-44 to 2^-12 are tried, and the polynomials expanded about
// (u, v), so that all that is not linear can be bounded by its coefficients.
std::optional<double> proved_zero(const IntegerNet& net, double u, double v, int most_squares = 5);

}  // namespace rondure
