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
Complex root_of(const Complex& h, long double n, HolonomyRoot which = HolonomyRoot::least) {
  const long double argument = std::arg(h), turn = 2 * std::numbers::pi_v<long double>;
  return std::polar(1.0L,
                    (which == HolonomyRoot::least ? argument : argument - std::copysign(turn, argument)) / n);
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

PreimageFamily bilinear_family(const SphericalQuad& quad) {
  const std::array<Spinor, 4> b = joined(sides_of(quad.arc));
  TensorPolynomial<ShapedPoint> net(1, 1);
  net.at(0, 0) = {{b[0], {0.25}}};
  net.at(1, 0) = {{b[1], {-0.25}}};
  net.at(1, 1) = {{b[2], {0.25}}};
  net.at(0, 1) = {{b[3], {-0.25}}};
  return {net, 1, 0, {}};
}

TensorPreimage bilinear_preimage(const SphericalQuad& quad, long double shape) {
  return std::get<TensorPreimage>(preimage_at(bilinear_family(quad), {{shape}}));
}

PreimageFamily linear_quadratic_family(const SphericalQuad& quad, HolonomyRoot root) {
  const auto [corner, g] = sides_of(quad.arc);
  const Complex h = g[0] * g[1] * g[2] * g[3];
  // The straight sides u = 0 and u = 1 from v = 0; times a linear factor they end in phases that the side
  // v = 1 joins. The defect is divided evenly, which keeps the factors farthest from zero.
  const Complex c = root_of(h, 2, root), d = c / h;
  const Spinor low[2] = {corner[0], g[0] * corner[1]};
  const Spinor high[2] = {(1.0L / g[3]) * corner[3], g[0] * g[1] * corner[2]};
  const Complex factor[2] = {c, d};
  TensorPolynomial<ShapedPoint> net(1, 2);
  for (int i = 0; i < 2; ++i) {
    const double more = i == 0 ? 0 : 0.5, first = i == 0 ? 0.5 : 0, second = 0.5 - first;
    net.at(i, 0) = {{low[i]}};
    net.at(i, 1) = {{Complex(0.5L) * high[i], {more, -first, -second}},
                    {Complex(0.5L) * (factor[i] * low[i]), {more, first, second}, {1}}};
    net.at(i, 2) = {{factor[i] * high[i], {2 * more}, {1}}};
  }
  return {net, 3, 1, {{std::arg(c), {1}}, {std::arg(d), {1}}}};
}

TensorPreimage linear_quadratic_preimage(const SphericalQuad& quad, HolonomyRoot root) {
  return std::get<TensorPreimage>(preimage_at(linear_quadratic_family(quad, root), {}));
}

PreimageFamily quadratic_linear_family(const SphericalQuad& quad, HolonomyRoot root) {
  // The same with corner 1 first: its (u, v) are our (v, 1 - u).
  const auto& arc = quad.arc;
  PreimageFamily family = linear_quadratic_family({{arc[1], arc[2], arc[3], arc[0]}}, root);
  const auto from = std::get<TensorPolynomial<ShapedPoint>>(family.net);
  TensorPolynomial<ShapedPoint> net(2, 1);
  for (int i = 0; i <= 2; ++i) {
    for (int j = 0; j <= 1; ++j) net.at(i, j) = from.at(j, 2 - i);
  }
  // Conics run the other way: all ratios are those of that quad inverted, and the turn is reversed.
  for (ShapedPoint& point : net.coefficients) {
    for (ShapedTerm& term : point.terms) {
      for (double& power : term.power) power = -power;
      term.turns[0] = -term.turns[0];
    }
  }
  for (SidePhase& side : family.sides) side.turns[0] = -side.turns[0];
  family.net = net;
  return family;
}

TensorPreimage quadratic_linear_preimage(const SphericalQuad& quad, HolonomyRoot root) {
  return std::get<TensorPreimage>(preimage_at(quadratic_linear_family(quad, root), {}));
}

PreimageFamily linear_family(const SphericalTriangle& triangle) {
  const std::array<Spinor, 3> b = joined(sides_of(triangle.arc));
  TrianglePolynomial<ShapedPoint> net(1);
  net.at(1, 0) = {{b[0]}};
  net.at(0, 1) = {{b[1]}};
  net.at(0, 0) = {{b[2]}};
  return {net, 0, 0, {}};
}

TrianglePreimage linear_preimage(const SphericalTriangle& triangle) {
  return std::get<TrianglePreimage>(preimage_at(linear_family(triangle), {}));
}

PreimageFamily quadratic_family(const SphericalTriangle& triangle, HolonomyRoot root) {
  const auto [corner, g] = sides_of(triangle.arc);
  // Each straight side times a linear factor from 1 to h, so that three of them close.
  const Complex h = std::conj(root_of(g[0] * g[1] * g[2], 3, root));
  TrianglePolynomial<ShapedPoint> net(2);
  const int at[3][2] = {{2, 0}, {0, 2}, {0, 0}}, between[3][2] = {{1, 1}, {0, 1}, {1, 0}};
  // Of the phases before each side, and of its own.
  const std::array<int, most_turns> before[3] = {{0, 0}, {1, 0}, {1, 1}}, after[3] = {{1, 0}, {1, 1}, {0, 0}};
  Complex phase = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Spinor start = phase * corner[k], end = phase * g[k] * corner[(k + 1) % 3];
    std::array<double, most_ratios> more{}, less{};
    more[k] = 0.5, less[k] = -0.5;
    net.at(at[k][0], at[k][1]) = {{start, {}, before[k]}};
    net.at(between[k][0], between[k][1]) = {{Complex(0.5L) * (h * start), more, after[k]},
                                            {Complex(0.5L) * end, less, before[k]}};
    phase *= h * g[k];
  }
  const long double even = std::arg(h);
  return {net, 3, 2, {{even, {1, 0}}, {even, {0, 1}}, {even, {-1, -1}}}};
}

TrianglePreimage quadratic_preimage(const SphericalTriangle& triangle, HolonomyRoot root) {
  return std::get<TrianglePreimage>(preimage_at(quadratic_family(triangle, root), {}));
}

}  // namespace rondure
