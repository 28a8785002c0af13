// Homogeneous systems of linear equations with complex coefficients.
#pragma once

#include <vector>

#include "renderer/projective/spinor.h"

namespace rondure {

struct NullVector {
  std::vector<Complex> vector;  // of length 1
  long double condition;        // least over greatest singular value of the rows
};

// A vector that all rows annihilate; there must be more unknowns than rows. By one-sided Jacobi rotations
// (Hestenes 1958), which make the rows orthogonal.
NullVector null_vector(std::vector<std::vector<Complex>> rows);

}  // namespace rondure
