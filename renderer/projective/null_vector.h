// Homogeneous systems of linear equations with complex coefficients.
#pragma once

#include <vector>

#include "renderer/projective/spinor.h"

namespace rondure {

struct NullVector {
  std::vector<Complex> vector;  // of length 1
  long double condition;        // of the rows' singular values that are not zero, least over greatest
  std::size_t nullity;          // how many independent solutions there are
};

// A vector that all rows annihilate, as well as rounding lets tell: singular values below 1e-13 of the
// greatest count as zero. The nullity must not be 0 for a vector to be found. By Householder's
// reflections to as many rows as unknowns, then one-sided Jacobi rotations (Hestenes 1958), which make those
// orthogonal.
NullVector null_vector(std::vector<std::vector<Complex>> rows);

}  // namespace rondure
