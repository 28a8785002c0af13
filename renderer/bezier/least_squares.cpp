#include "renderer/bezier/least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rondure {
namespace {

double norm(const double* v, std::size_t n) {
  double sum = 0.0;
  for (std::size_t k = 0; k < n; ++k) sum += v[k] * v[k];
  return std::sqrt(sum);
}

// target -= 2 (h . target) h for a unit h.
void reflect(const double* h, double* target, std::size_t n) {
  double sum = 0.0;
  for (std::size_t k = 0; k < n; ++k) sum += h[k] * target[k];
  for (std::size_t k = 0; k < n; ++k) target[k] -= 2.0 * sum * h[k];
}

// A becomes R in its upper triangle; the right sides become Q^T b.
void factorise(Matrix& a, std::vector<std::vector<double>>& right_sides) {
  std::vector<double> h(a.rows);
  double largest = 0.0;
  for (std::size_t c = 0; c < a.columns; ++c)
    largest = std::max(largest, norm(&a.entries[c * a.rows], a.rows));
  const double tiny = std::numeric_limits<double>::epsilon() * 0x1p-20 * largest;
  for (std::size_t c = 0; c < a.columns; ++c) {
    const std::size_t length = a.rows - c;
    double* column = &a.entries[c * a.rows + c];
    double pivot = norm(column, length);
    if (pivot > 0.0) {
      if (column[0] > 0.0) pivot = -pivot;
      std::copy_n(column, length, h.begin());
      h[0] -= pivot;
      const double size = norm(h.data(), length);
      for (std::size_t k = 0; k < length; ++k) h[k] /= size;
      for (std::size_t d = c + 1; d < a.columns; ++d) reflect(h.data(), &a.entries[d * a.rows + c], length);
      for (auto& b : right_sides) reflect(h.data(), &b[c], length);
    }
    // A pivot of zero would divide by zero below; one far below rounding makes the null direction stand out.
    column[0] = std::abs(pivot) > tiny ? pivot : tiny;
  }
}

// R x = b
void solve_upper(const Matrix& r, std::vector<double>& b) {
  for (std::size_t i = r.columns; i-- > 0;) {
    b[i] /= r.at(i, i);
    for (std::size_t k = 0; k < i; ++k) b[k] -= r.at(k, i) * b[i];
  }
}

// R^T x = b
void solve_lower(const Matrix& r, std::vector<double>& b) {
  for (std::size_t i = 0; i < r.columns; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= r.at(k, i) * b[k];
    b[i] /= r.at(i, i);
  }
}

}  // namespace

std::vector<std::vector<double>> least_squares(Matrix a, std::vector<std::vector<double>> right_sides) {
  factorise(a, right_sides);
  for (auto& b : right_sides) {
    solve_upper(a, b);
    b.resize(a.columns);
  }
  return right_sides;
}

NullDirection null_direction(Matrix a) {
  double largest = 0.0;
  for (std::size_t c = 0; c < a.columns; ++c)
    largest = std::max(largest, norm(&a.entries[c * a.rows], a.rows));
  std::vector<std::vector<double>> none;
  factorise(a, none);
  NullDirection out;
  out.x.assign(a.columns, 1.0);
  // Four steps: each gains the square of the ratio of the two least singular values.
  double gain = 1.0;
  for (int step = 0; step < 4; ++step) {
    const double before = norm(out.x.data(), a.columns);
    for (double& x : out.x) x /= before;
    solve_lower(a, out.x);
    solve_upper(a, out.x);
    gain = norm(out.x.data(), a.columns);
  }
  for (double& x : out.x) x /= gain;
  out.size = largest > 0.0 ? 1.0 / std::sqrt(gain) / largest : 0.0;
  return out;
}

}  // namespace rondure
