#include "renderer/projective/orientation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/bezier/tensor.h"
#include "renderer/bezier/triangle.h"
#include "renderer/projective/spinor.h"

namespace rondure {
namespace {

constexpr auto spinor_determinant = [](const lvec4& p, const lvec4& q) {
  return det(to_spinor(p), to_spinor(q));
};

// -4 Im(conj(a) b), the Jacobian from the determinants of the preimage with its derivatives.
template <class Polynomial>
auto jacobian(const Polynomial& in_u, const Polynomial& in_v) {
  return multiply(in_u, in_v,
                  [](const Complex& a, const Complex& b) { return -4 * (std::conj(a) * b).imag(); });
}

// Coefficients of the sum over i >= a, j >= b: one degree less in the directions that are 1.
TensorPreimage part(const TensorPreimage& p, int less_u, int less_v, int a, int b) {
  TensorPreimage out(p.m - less_u, p.n - less_v);
  for (int i = 0; i <= out.m; ++i) {
    for (int j = 0; j <= out.n; ++j) out.at(i, j) = p.at(i + a, j + b);
  }
  return out;
}

TrianglePreimage part(const TrianglePreimage& p, int a, int b) {
  TrianglePreimage out(p.n - 1);
  for (int i = 0; i <= out.n; ++i) {
    for (int j = 0; j <= out.n - i; ++j) out.at(i, j) = p.at(i + a, j + b);
  }
  return out;
}

TrianglePreimage difference(const TrianglePreimage& p, const TrianglePreimage& q) {
  return add_scaled(p, q, -1.0L);
}

// A scalar polynomial on a piece of the domain, whose corners are as in base_points.
struct Cell {
  std::vector<double> c;
  dvec2 corner[3];
  int depth;
};

dvec2 middle_of(const TensorPolynomial<long double>&, const Cell& c) {
  return 0.5 * (c.corner[0] + c.corner[1]);
}
dvec2 middle_of(const TrianglePolynomial<long double>&, const Cell& c) {
  return (c.corner[0] + c.corner[1] + c.corner[2]) / 3.0;
}

// A coefficient that is a value of the polynomial, and below the limit; null when there is none.
bool corner_below(const TensorPolynomial<long double>& p, const Cell& c, double limit, dvec2& where) {
  const dvec2 low = c.corner[0], high = c.corner[1];
  const auto n = static_cast<std::size_t>(p.n), last = c.c.size() - 1;
  const std::pair<std::size_t, dvec2> corners[] = {
      {0, low}, {n, {low.x, high.y}}, {last - n, {high.x, low.y}}, {last, high}};
  for (const auto& [at, place] : corners) {
    if (c.c[at] < limit) return where = place, true;
  }
  return false;
}

bool corner_below(const TrianglePolynomial<long double>& p, const Cell& c, double limit, dvec2& where) {
  const std::pair<int, dvec2> corners[] = {{triangle_index(p.n, p.n, 0), c.corner[0]},
                                           {triangle_index(p.n, 0, p.n), c.corner[1]},
                                           {triangle_index(p.n, 0, 0), c.corner[2]}};
  for (const auto& [at, place] : corners) {
    if (c.c[static_cast<std::size_t>(at)] < limit) return where = place, true;
  }
  return false;
}

void push_parts(const TensorPolynomial<long double>& p, const Cell& cell, std::vector<Cell>& cells) {
  std::vector<double> low(cell.c.size()), high(cell.c.size());
  dvec2 a = cell.corner[0], b = cell.corner[1];
  const bool along_u = cell.depth % 2 == 0;
  (along_u ? tensor_halve_u<double> : tensor_halve_v<double>)(cell.c.data(), p.m, p.n, low.data(),
                                                              high.data());
  const int axis = along_u ? 0 : 1;
  const double middle = 0.5 * (a[axis] + b[axis]);
  dvec2 low_end = b, high_start = a;
  low_end[axis] = high_start[axis] = middle;
  cells.push_back({std::move(low), {a, low_end, low_end}, cell.depth + 1});
  cells.push_back({std::move(high), {high_start, b, b}, cell.depth + 1});
}

void push_parts(const TrianglePolynomial<long double>& p, const Cell& cell, std::vector<Cell>& cells) {
  std::vector<double> low(cell.c.size()), high(cell.c.size());
  triangle_bisect(cell.c.data(), p.n, low.data(), high.data());
  const dvec2 &u = cell.corner[0], &v = cell.corner[1], &w = cell.corner[2];
  const dvec2 middle = 0.5 * (u + v);
  // Relabelled without change of the polynomial's values: the next edge to halve comes first.
  const auto turned = [&](const std::vector<double>& c) {
    std::vector<double> out(c.size());
    for (int i = 0; i <= p.n; ++i) {
      for (int j = 0; j <= p.n - i; ++j) {
        out[static_cast<std::size_t>(triangle_index(p.n, p.n - i - j, i))] =
            c[static_cast<std::size_t>(triangle_index(p.n, i, j))];
      }
    }
    return out;
  };
  cells.push_back({turned(low), {w, u, middle}, cell.depth + 1});
  cells.push_back({turned(high), {w, middle, v}, cell.depth + 1});
}

Cell whole(const TensorPolynomial<long double>&) { return {{}, {dvec2(0.0), dvec2(1.0), dvec2(1.0)}, 0}; }
Cell whole(const TrianglePolynomial<long double>&) { return {{}, {{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}}, 0}; }

// Whether the polynomial is positive inside: no Bernstein coefficient is negative on any piece. Rounding is
// relative to the largest coefficient.
template <class Polynomial>
PreimageRegularity positive(const Polynomial& p) {
  constexpr int deepest = 16;
  std::vector<Cell> cells{whole(p)};
  double largest = 0.0;
  for (const long double c : p.coefficients) {
    cells[0].c.push_back(static_cast<double>(c));
    largest = std::max(largest, std::abs(cells[0].c.back()));
  }
  const double noise = 1e-13 * largest;
  PreimageRegularity result{largest > 0.0, middle_of(p, cells[0])};
  while (result.regular && !cells.empty()) {
    const Cell cell = std::move(cells.back());
    cells.pop_back();
    const auto [least, most] = std::minmax_element(cell.c.begin(), cell.c.end());
    if (*least >= -noise && *most > 0.0) continue;
    result.worst = middle_of(p, cell);
    result.regular = !corner_below(p, cell, -noise, result.worst) && cell.depth < deepest;
    push_parts(p, cell, cells);
  }
  return result;
}

// The determinants of the derivatives in u and in v with the preimage itself.
auto determinants(const TensorPreimage& p) {
  // det(psi_u, psi) = m det(high part, low part): one degree less than the product, twice.
  auto in_u = multiply(part(p, 1, 0, 1, 0), part(p, 1, 0, 0, 0), spinor_determinant);
  auto in_v = multiply(part(p, 0, 1, 0, 1), part(p, 0, 1, 0, 0), spinor_determinant);
  for (Complex& c : in_u.coefficients) c *= p.m;
  for (Complex& c : in_v.coefficients) c *= p.n;
  return std::pair(std::move(in_u), std::move(in_v));
}

auto determinants(const TrianglePreimage& p) {
  const TrianglePreimage in_w = part(p, 0, 0);
  auto in_u = multiply(difference(part(p, 1, 0), in_w), p, spinor_determinant);
  auto in_v = multiply(difference(part(p, 0, 1), in_w), p, spinor_determinant);
  for (Complex& c : in_u.coefficients) c *= p.n;
  for (Complex& c : in_v.coefficients) c *= p.n;
  return std::pair(std::move(in_u), std::move(in_v));
}

template <class Polynomial>
long double largest_of(const Polynomial& p) {
  long double largest = 0;
  for (const auto& c : p.coefficients) largest = std::max(largest, std::abs(c));
  return largest;
}

// The share of |psi_u| |psi_v| below which J counts for nothing: corners in doubles tell no more.
constexpr long double flat_angle = 1e-12L;

}  // namespace

TensorPolynomial<long double> orientation(const TensorPreimage& p) {
  const auto [in_u, in_v] = determinants(p);
  return jacobian(in_u, in_v);
}

TrianglePolynomial<long double> orientation(const TrianglePreimage& p) {
  const auto [in_u, in_v] = determinants(p);
  return jacobian(in_u, in_v);
}

PreimageRegularity regularity(const Preimage& preimage) {
  return std::visit(
      [](const auto& p) {
        const auto [in_u, in_v] = determinants(p);
        const auto j = jacobian(in_u, in_v);
        PreimageRegularity result = positive(j);
        result.flat = !(largest_of(j) > flat_angle * 4 * largest_of(in_u) * largest_of(in_v));
        result.regular = result.regular && !result.flat;
        return result;
      },
      preimage);
}

}  // namespace rondure
