#include "renderer/projective/sphere_curve.h"

#include <algorithm>

#include "renderer/bezier/product.h"
#include "renderer/projective/null_vector.h"

namespace rondure {
namespace {

// B_k^n(t) for k = 0..n.
std::vector<long double> basis(std::size_t n, long double t) {
  std::vector<long double> b{1};
  for (std::size_t degree = 1; degree <= n; ++degree) {
    b.push_back(0);
    for (std::size_t k = degree; k > 0; --k) b[k] = (1 - t) * b[k] + t * b[k - 1];
    b[0] *= 1 - t;
  }
  return b;
}

}  // namespace

std::vector<lvec4> curve_image(const std::vector<lvec4>& preimage) {
  const TensorPolynomial<lvec4> p(static_cast<int>(preimage.size()) - 1, 0, preimage);
  return multiply(p, p, [](const lvec4& a, const lvec4& b) { return delta(a, b); }).coefficients;
}

std::vector<lvec4> circle_through(const lvec3& p, const lvec3& r, const lvec3& q) {
  const Spinor start = spinor_at(p), end = spinor_at(q);
  return {to_point(start), to_point(arc_phase(start, spinor_at(r), end) * end)};
}

Interpolation interpolate(const std::vector<lvec3>& points, const std::vector<long double>& parameters) {
  // det(y(t_i), q_i) = 0: the curve meets the projecting line over point i.
  const std::size_t n = (points.size() - 1) / 2;
  std::vector<std::vector<Complex>> rows;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Spinor q = spinor_at(points[i]);
    const std::vector<long double> b = basis(n, parameters[i]);
    std::vector<Complex> row;
    for (const long double value : b) row.push_back(value * q.b);
    for (const long double value : b) row.push_back(-value * q.a);
    rows.push_back(std::move(row));
  }
  const NullVector solution = null_vector(rows);
  Interpolation out;
  out.condition = solution.condition;
  for (std::size_t k = 0; k <= n; ++k)
    out.preimage.push_back(to_point(Spinor{solution.vector[k], solution.vector[n + 1 + k]}));
  // Against the largest control point: where all that count at a parameter vanish, they do so but for
  // rounding.
  long double size = 0;
  for (const lvec4& y : out.preimage) size = std::max(size, glm::length(y));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<long double> b = basis(n, parameters[i]);
    lvec4 value(0);
    for (std::size_t k = 0; k <= n; ++k) value += b[k] * out.preimage[k];
    if (glm::length(value) <= 1e-12L * size) out.inaccessible.push_back(i);
  }
  return out;
}

CircularSpline circular_spline(const std::vector<lvec3>& points, const lvec3& on_first) {
  CircularSpline spline;
  std::vector<Spinor> b;
  for (const lvec4& p : circle_through(points[0], on_first, points[1])) b.push_back(to_spinor(p));
  spline.intervals.push_back(1);
  for (std::size_t k = 2; k < points.size(); ++k) {
    const Spinor next = spinor_at(points[k]);
    const Spinor here = b[k - 1], before = b[k - 2];
    const Complex turn = -det(here, before) / det(here, next);
    b.push_back((turn / std::abs(turn)) * next);
    const long double ratio = std::abs(det(b[k], here)) / std::abs(det(before, here));
    spline.intervals.push_back(spline.intervals.back() * ratio);
  }
  for (const Spinor& s : b) spline.preimage.push_back(to_point(s));
  return spline;
}

}  // namespace rondure
