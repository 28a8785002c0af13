// The solutions of homogeneous systems of linear equations, exactly or as well as rounding lets tell.
#pragma once

#include <limits>
#include <vector>

#include "renderer/complex/spline_conditions.h"

namespace rondure {

struct NullSpace {
  std::vector<SparseRow> basis;
  std::vector<int> free;  // basis[k] is 1 at unknown free[k] and 0 at the other free ones
  int rank = 0;
  bool exact = true;
  // Of rounded systems: the least singular value that counts over the largest that does not; infinite where
  // there is none of these.
  double gap = std::numeric_limits<double>::infinity();
};

// `order` lists all unknowns that the rows have, those first that are to be expressed by the others: the free
// unknowns are as far back as they can be. By elimination without fractions (Bareiss 1968), rows kept sparse
// and their common factors divided out.
NullSpace exact_null_space(const std::vector<SparseRow>& rows, const std::vector<int>& order);

// The same from coefficients rounded to double: the rank is where the singular values fall most steeply below
// 1e-6 of the largest, and elimination with row pivots finds as many unknowns to express. Throws
// std::runtime_error where the fall is by less than 10^3 or elimination disagrees: then the rank is not
// clear.
NullSpace rounded_null_space(const std::vector<SparseRow>& rows, const std::vector<int>& order);

// The largest entry of the basis, in size.
double largest_entry(const NullSpace& space);

}  // namespace rondure
