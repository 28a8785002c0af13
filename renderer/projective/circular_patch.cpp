#include "renderer/projective/circular_patch.h"

#include <numbers>

namespace rondure {
namespace {

template <std::size_t N>
struct Sides {
  std::array<Spinor, N> corner;  // of length 1
  std::array<Complex, N> phase;  // arc k: (1 - t) corner k + t phase k times corner k + 1
};

template <std::size_t N>
Sides<N> sides_of(const std::array<SphereArc, N>& arcs) {
  Sides<N> sides;
  for (std::size_t k = 0; k < N; ++k) sides.corner[k] = spinor_at(arcs[k].p);
  for (std::size_t k = 0; k < N; ++k) {
    const lvec3 middle = glm::normalize(arcs[k].p + arcs[k].q + 2.0L * arcs[k].b);
    sides.phase[k] = arc_phase(sides.corner[k], spinor_at(middle), sides.corner[(k + 1) % N]);
  }
  return sides;
}

template <std::size_t N>
Complex around(const Sides<N>& sides) {
  Complex product = 1;
  for (const Complex& g : sides.phase) product *= g;
  return product / std::abs(product);
}

// exp of i times the argument over n: the n-th root with the smallest argument, or the next one.
Complex root_of(const Complex& h, long double n, Root which = Root::least) {
  const long double argument = std::arg(h), turn = 2 * std::numbers::pi_v<long double>;
  return std::polar(1.0L, (which == Root::least ? argument : argument - std::copysign(turn, argument)) / n);
}

// The corners on one line of phases, with the defect of the holonomy spread over the sides.
template <std::size_t N>
std::array<Spinor, N> joined(const Sides<N>& sides) {
  const Complex less = std::conj(root_of(around(sides), N));
  std::array<Spinor, N> points;
  Complex phase = 1;
  for (std::size_t k = 0; k < N; ++k) {
    points[k] = phase * sides.corner[k];
    phase *= sides.phase[k] * less;
  }
  return points;
}

}  // namespace

Complex holonomy(const SphericalQuad& quad) { return around(sides_of(quad.arc)); }
Complex holonomy(const SphericalTriangle& t) { return around(sides_of(t.arc)); }

TensorPreimage bilinear_preimage(const SphericalQuad& quad, long double shape) {
  const std::array<Spinor, 4> b = joined(sides_of(quad.arc));
  const long double more = std::sqrt(std::sqrt(shape));
  TensorPreimage p(1, 1);
  p.at(0, 0) = more * to_point(b[0]);
  p.at(1, 0) = to_point(b[1]) / more;
  p.at(1, 1) = more * to_point(b[2]);
  p.at(0, 1) = to_point(b[3]) / more;
  return p;
}

TensorPreimage linear_quadratic_preimage(const SphericalQuad& quad, Root root) {
  const auto [corner, g] = sides_of(quad.arc);
  const Complex h = g[0] * g[1] * g[2] * g[3];
  // The straight sides u = 0 and u = 1 from v = 0; times a linear factor they end in phases that the side
  // v = 1 joins. The defect is divided evenly, which keeps the factors farthest from zero.
  const Complex c = root_of(h, 2, root), d = c / h;
  const Spinor low[2] = {corner[0], g[0] * corner[1]};
  const Spinor high[2] = {(1.0L / g[3]) * corner[3], g[0] * g[1] * corner[2]};
  const Complex factor[2] = {c, d};
  TensorPreimage p(1, 2);
  for (int i = 0; i < 2; ++i) {
    p.at(i, 0) = to_point(low[i]);
    p.at(i, 1) = to_point(Complex(0.5L) * (high[i] + factor[i] * low[i]));
    p.at(i, 2) = to_point(factor[i] * high[i]);
  }
  return p;
}

TensorPreimage quadratic_linear_preimage(const SphericalQuad& quad, Root root) {
  // The same with corner 1 first: its (u, v) are our (v, 1 - u).
  const auto& arc = quad.arc;
  const TensorPreimage from = linear_quadratic_preimage({{arc[1], arc[2], arc[3], arc[0]}}, root);
  TensorPreimage p(2, 1);
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; j <= 1; ++j) p.at(i, j) = from.at(j, 2 - i);
  }
  return p;
}

TrianglePreimage linear_preimage(const SphericalTriangle& triangle) {
  const std::array<Spinor, 3> b = joined(sides_of(triangle.arc));
  TrianglePreimage p(1);
  p.at(1, 0) = to_point(b[0]);
  p.at(0, 1) = to_point(b[1]);
  p.at(0, 0) = to_point(b[2]);
  return p;
}

TrianglePreimage quadratic_preimage(const SphericalTriangle& triangle, Root root) {
  const auto [corner, g] = sides_of(triangle.arc);
  // Each straight side times a linear factor from 1 to h, so that three of them close.
  const Complex h = std::conj(root_of(g[0] * g[1] * g[2], 3, root));
  TrianglePreimage p(2);
  const int at[3][2] = {{2, 0}, {0, 2}, {0, 0}}, between[3][2] = {{1, 1}, {0, 1}, {1, 0}};
  Complex phase = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Spinor start = corner[k], end = g[k] * corner[(k + 1) % 3];
    p.at(at[k][0], at[k][1]) = to_point(phase * start);
    p.at(between[k][0], between[k][1]) = to_point(Complex(0.5L) * phase * (h * start + end));
    phase *= h * g[k];
  }
  return p;
}

}  // namespace rondure
