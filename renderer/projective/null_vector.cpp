#include "renderer/projective/null_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rondure {
namespace {

using Row = std::vector<Complex>;

// Sum of conj(a_k) b_k.
Complex inner(const Row& a, const Row& b) {
  long double real = 0, imag = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    real += a[k].real() * b[k].real() + a[k].imag() * b[k].imag();
    imag += a[k].real() * b[k].imag() - a[k].imag() * b[k].real();
  }
  return {real, imag};
}

// Singular values below this fraction of the greatest are zero.
constexpr long double negligible = 1e-13L;

// Rotates two rows until they are orthogonal; false when they are already, or shorter than `zero`, whose
// square is given, as are theirs, pp and qq.
bool rotate(Row& p, Row& q, long double& pp, long double& qq, long double zero) {
  if (pp <= zero || qq <= zero) return false;
  const Complex pq = inner(p, q);
  const long double size = std::abs(pq);
  if (!(size > 4 * std::numeric_limits<long double>::epsilon() * std::sqrt(pp * qq))) return false;
  const Complex phase = pq / size;
  const long double theta = (qq - pp) / (2 * size);
  const long double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::hypot(theta, 1.0L));
  const long double c = 1 / std::hypot(t, 1.0L), s = t * c;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Complex a = p[k], b = std::conj(phase) * q[k];
    p[k] = c * a - s * b;
    q[k] = s * a + c * b;
  }
  pp = inner(p, p).real(), qq = inner(q, q).real();
  return true;
}

// As many rows as unknowns, of the same span and singular values (Householder's triangular factor), where
// there are more: rotations then have fewer pairs to turn.
void reduce(std::vector<Row>& rows) {
  const std::size_t unknowns = rows[0].size();
  if (rows.size() <= unknowns) return;
  std::vector<Complex> v(rows.size());
  for (std::size_t k = 0; k < unknowns; ++k) {
    long double square = 0;
    for (std::size_t i = k; i < rows.size(); ++i) square += std::norm(v[i] = rows[i][k]);
    if (!(square > 0)) continue;
    const long double length = std::sqrt(square), size = std::abs(v[k]);
    // Away from the first entry, so that nothing cancels.
    v[k] += size > 0 ? v[k] * (length / size) : Complex(length);
    const long double half = length * (length + size);  // half of v's squared length
    for (std::size_t j = k; j < unknowns; ++j) {
      Complex along = 0;
      for (std::size_t i = k; i < rows.size(); ++i) along += std::conj(v[i]) * rows[i][j];
      along /= half;
      for (std::size_t i = k; i < rows.size(); ++i) rows[i][j] -= along * v[i];
    }
    for (std::size_t i = k + 1; i < rows.size(); ++i) rows[i][k] = 0;
  }
  rows.resize(unknowns);
}

}  // namespace

NullVector null_vector(std::vector<Row> rows) {
  const std::size_t unknowns = rows[0].size();
  // The rows' conjugates are what the solution is orthogonal to.
  for (Row& row : rows) {
    for (Complex& c : row) c = std::conj(c);
  }
  reduce(rows);
  long double total = 0;
  for (const Row& row : rows) total += inner(row, row).real();
  // Far below what counts: rows that rotations have emptied are only noise.
  const long double zero = 1e-34L * total;
  std::vector<long double> squares;
  for (const Row& row : rows) squares.push_back(inner(row, row).real());
  bool turned = true;
  for (int sweep = 0; turned && sweep < 60; ++sweep) {
    turned = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = i + 1; j < rows.size(); ++j)
        turned = rotate(rows[i], rows[j], squares[i], squares[j], zero) || turned;
    }
  }
  // What is left is orthogonal: singular values and vectors.
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return squares[a] > squares[b]; });
  const long double largest = std::sqrt(squares[order.front()]);
  while (order.size() > 1 && std::sqrt(squares[order.back()]) <= negligible * largest) order.pop_back();
  NullVector out{{}, std::sqrt(squares[order.back()]) / largest, unknowns - std::min(order.size(), unknowns)};
  if (out.nullity == 0) return out;
  // Of the unit vectors the one that sticks out of their span most.
  std::size_t farthest = 0;
  long double least = INFINITY;
  for (std::size_t k = 0; k < unknowns; ++k) {
    long double inside = 0;
    for (const std::size_t i : order) inside += std::norm(rows[i][k]) / squares[i];
    if (inside < least) least = inside, farthest = k;
  }
  out.vector.assign(unknowns, 0);
  out.vector[farthest] = 1;
  for (int pass = 0; pass < 2; ++pass) {  // the second removes what rounding left
    for (const std::size_t i : order) {
      const Complex along = inner(rows[i], out.vector) / squares[i];
      for (std::size_t k = 0; k < unknowns; ++k) out.vector[k] -= along * rows[i][k];
    }
  }
  const long double length = std::sqrt(inner(out.vector, out.vector).real());
  for (Complex& c : out.vector) c /= length;
  return out;
}

}  // namespace rondure
