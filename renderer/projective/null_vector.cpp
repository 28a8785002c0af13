#include "renderer/projective/null_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rondure {
namespace {

using Row = std::vector<Complex>;

// Sum of conj(a_k) b_k.
Complex inner(const Row& a, const Row& b) {
  Complex sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += std::conj(a[k]) * b[k];
  return sum;
}

// Singular values below this fraction of the greatest are zero.
constexpr long double negligible = 1e-13L;

// Rotates two rows until they are orthogonal; false when they are already, or shorter than `zero`, whose
// square is given.
bool rotate(Row& p, Row& q, long double zero) {
  const long double pp = inner(p, p).real(), qq = inner(q, q).real();
  const Complex pq = inner(p, q);
  const long double size = std::abs(pq);
  if (pp <= zero || qq <= zero) return false;
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
  return true;
}

}  // namespace

NullVector null_vector(std::vector<Row> rows) {
  const std::size_t unknowns = rows[0].size();
  // The rows' conjugates are what the solution is orthogonal to.
  for (Row& row : rows) {
    for (Complex& c : row) c = std::conj(c);
  }
  long double total = 0;
  for (const Row& row : rows) total += inner(row, row).real();
  // Far below what counts: rows that rotations have emptied are only noise.
  const long double zero = 1e-34L * total;
  bool turned = true;
  for (int sweep = 0; turned && sweep < 60; ++sweep) {
    turned = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = i + 1; j < rows.size(); ++j) turned = rotate(rows[i], rows[j], zero) || turned;
    }
  }
  std::sort(rows.begin(), rows.end(),
            [](const Row& a, const Row& b) { return inner(a, a).real() > inner(b, b).real(); });
  const auto length_of = [](const Row& row) { return std::sqrt(inner(row, row).real()); };
  const long double largest = length_of(rows.front());
  while (rows.size() > 1 && length_of(rows.back()) <= negligible * largest) rows.pop_back();
  NullVector out{{}, length_of(rows.back()) / largest, unknowns - std::min(rows.size(), unknowns)};
  if (out.nullity == 0) return out;
  // Of the unit vectors the one that sticks out of their span most.
  long double best = -1;
  for (std::size_t k = 0; k < unknowns; ++k) {
    Row v(unknowns, 0);
    v[k] = 1;
    for (int pass = 0; pass < 2; ++pass) {  // the second removes what rounding left
      for (const Row& row : rows) {
        const long double square = inner(row, row).real();
        const Complex along = inner(row, v) / square;
        for (std::size_t i = 0; i < unknowns; ++i) v[i] -= along * row[i];
      }
    }
    const long double length = std::sqrt(inner(v, v).real());
    if (length <= best) continue;
    best = length;
    for (Complex& c : v) c /= length;
    out.vector = std::move(v);
  }
  return out;
}

}  // namespace rondure
