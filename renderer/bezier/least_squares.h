// Small dense least-squares problems by Householder's QR factorisation.
#pragma once

#include <cstddef>
#include <vector>

namespace rondure {

// Column by column: entry (r, c) at entries[c * rows + r]. rows >= columns >= 1.
struct Matrix {
  std::size_t rows, columns;
  std::vector<double> entries;

  Matrix(std::size_t row_count, std::size_t column_count)
      : rows(row_count), columns(column_count), entries(row_count * column_count, 0.0) {}
  double& at(std::size_t r, std::size_t c) { return entries[c * rows + r]; }
  double at(std::size_t r, std::size_t c) const { return entries[c * rows + r]; }
};

// The x that minimises |A x - b|, for every b at once: all have A's rows.
std::vector<std::vector<double>> least_squares(Matrix a, std::vector<std::vector<double>> right_sides);

// The unit x that makes |A x| least, and that least relative to the largest column of A. Both by inverse
// iteration on A^T A; good to about eps / (the next singular value, relative).
struct NullDirection {
  std::vector<double> x;
  double size = 0.0;
};
NullDirection null_direction(Matrix a);

}  // namespace rondure
