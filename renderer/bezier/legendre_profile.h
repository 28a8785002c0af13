// Bounds of a bivariate polynomial in the complex plane, from its values at the nodes of two quadrature
// rules.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "renderer/bezier/gauss_rule.h"

namespace rondure {

// Values at the nodes (rounded to double) or coefficients, (i, j) at [i * columns + j].
using Grid = std::vector<double>;

inline std::size_t grid_index(int row, int columns, int column) {
  return static_cast<std::size_t>(row * columns + column);
}

// The Legendre coefficients of the polynomial with these values, [k * (n + 1) + l], and their rounding error
// per (2k + 1)(2l + 1).
struct Series {
  int m = 0, n = 0;
  Grid coefficients;
  double error = 0.0;
};

// Of a polynomial of the degree (m, n), below the count of nodes in each direction.
Series series(const Grid& values, int m, int n, const GaussRule& in_u, const GaussRule& in_v);

// Sums of |c_kl| over the direction that stays real, by the index of the one that is made complex.
struct Profile {
  double middle = 0.0;  // c_00
  Grid in_u, in_v;

  double bound(bool along_u, const Grid& growth) const {
    const Grid& sums = along_u ? in_u : in_v;
    double total = 0.0;
    for (std::size_t k = 0; k < sums.size(); ++k) total += sums[k] * growth[k];
    return total;
  }
  // Of what is left without c_00.
  double deviation(bool along_u, const Grid& growth) const {
    return bound(along_u, growth) - std::abs(middle);
  }
};

Profile profile(const Series& s);

}  // namespace rondure
