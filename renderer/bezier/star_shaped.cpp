#include "renderer/bezier/star_shaped.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/product.h"
#include "renderer/bezier/triangle.h"

namespace rondure {
namespace {

using VectorTensor = TensorPolynomial<dvec3>;
using VectorTriangle = TrianglePolynomial<dvec3>;

// X over a piece of the domain, and the piece's corners (u, v).
template <class Polynomial, std::size_t Corners>
struct Piece {
  Polynomial x;
  std::array<dvec2, Corners> corners;
};
using TensorPiece = Piece<VectorTensor, 4>;  // at (0, 0), (1, 0), (0, 1), (1, 1)
using TrianglePiece = Piece<VectorTriangle, 3>;

std::array<TensorPiece, 4> quarters(const TensorPiece& p) {
  const auto& c = p.corners;
  const VectorTensor empty(p.x.m, p.x.n);
  std::array<TensorPiece, 4> out;
  for (TensorPiece& q : out) q.x = empty;
  VectorTensor low = empty, high = empty;
  tensor_halve_u(p.x.coefficients.data(), p.x.m, p.x.n, low.coefficients.data(), high.coefficients.data());
  for (std::size_t k = 0; k < 2; ++k) {
    tensor_halve_v((k == 0 ? low : high).coefficients.data(), p.x.m, p.x.n, out[k].x.coefficients.data(),
                   out[k + 2].x.coefficients.data());
  }
  const dvec2 a = c[0], e = 0.5 * (c[1] - c[0]), f = 0.5 * (c[2] - c[0]);
  for (std::size_t k = 0; k < 4; ++k) {
    const dvec2 low_corner = a + (k % 2 == 1 ? e : dvec2(0.0)) + (k / 2 == 1 ? f : dvec2(0.0));
    out[k].corners = {low_corner, low_corner + e, low_corner + f, low_corner + e + f};
  }
  return out;
}

std::array<TrianglePiece, 4> quarters(const TrianglePiece& p) {
  std::array<TrianglePiece, 4> out;
  for (TrianglePiece& q : out) q.x = VectorTriangle(p.x.n);
  triangle_quarter(p.x.coefficients.data(), p.x.n, out[0].x.coefficients.data(), out[1].x.coefficients.data(),
                   out[2].x.coefficients.data(), out[3].x.coefficients.data());
  const dvec2 a = p.corners[0], b = p.corners[1], c = p.corners[2];
  const dvec2 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ac = 0.5 * (a + c);
  out[0].corners = {a, ab, ac};
  out[1].corners = {ab, b, bc};
  out[2].corners = {ac, bc, c};
  out[3].corners = {bc, ac, ab};
  return out;
}

std::array<VectorTensor, 2> derivatives(const VectorTensor& x) {
  std::array<VectorTensor, 2> d{VectorTensor(x.m - 1, x.n), VectorTensor(x.m, x.n - 1)};
  tensor_derivative_u(x.coefficients.data(), x.m, x.n, d[0].coefficients.data());
  tensor_derivative_v(x.coefficients.data(), x.m, x.n, d[1].coefficients.data());
  return d;
}

std::array<VectorTriangle, 2> derivatives(const VectorTriangle& x) {
  std::array<VectorTriangle, 2> d{VectorTriangle(x.n - 1), VectorTriangle(x.n - 1)};
  triangle_derivative_u(x.coefficients.data(), x.n, d[0].coefficients.data());
  triangle_derivative_v(x.coefficients.data(), x.n, d[1].coefficients.data());
  return d;
}

int degree_of(const VectorTensor& x) { return std::max(x.m, x.n); }
int degree_of(const VectorTriangle& x) { return x.n; }

// The coefficients at the corners: values of the polynomial.
std::array<double, 4> corner_values(const TensorPolynomial<double>& p) {
  return {p.at(0, 0), p.at(p.m, 0), p.at(0, p.n), p.at(p.m, p.n)};
}
std::array<double, 3> corner_values(const TrianglePolynomial<double>& p) {
  return {p.at(p.n, 0), p.at(0, p.n), p.at(0, 0)};
}

double largest(const std::vector<dvec3>& x) {
  double size = 0.0;
  for (const dvec3& p : x) size = std::max(size, glm::length(p));
  return size;
}

template <class Polynomial>
auto determinant(const Polynomial& x, double& noise) {
  const auto d = derivatives(x);
  const auto cross = [](const dvec3& a, const dvec3& b) { return glm::cross(a, b); };
  const auto dot = [](const dvec3& a, const dvec3& b) { return glm::dot(a, b); };
  // A derivative is a difference: it has the rounding of X, times the degree. The products add a unit for
  // each of the some 10 operations on a coefficient; convolution sums terms of weights that sum to 1.
  const double size = largest(x.coefficients), a = largest(d[0].coefficients), b = largest(d[1].coefficients);
  noise = 0x1p-53 * size * (2.0 * degree_of(x) * size * (a + b) + 16.0 * a * b);
  return multiply(x, multiply(d[0], d[1], cross), dot);
}

template <class Piece>
std::optional<Fold> fold_of(const Piece& whole) {
  constexpr int most_pieces = 4096;
  double sign = 0.0;
  std::vector<Piece> stack{whole};
  for (int visited = 0; !stack.empty(); ++visited) {
    const Piece piece = stack.back();
    stack.pop_back();
    double noise = 0.0;
    const auto det = determinant(piece.x, noise);
    const auto [low, high] = std::minmax_element(det.coefficients.begin(), det.coefficients.end());
    if (visited == 0) {
      sign = *high >= -*low ? 1.0 : -1.0;
      if (!(sign * (sign > 0.0 ? *high : *low) > noise)) return Fold{dvec2(1.0 / 3.0), true};
    }
    if ((sign > 0.0 ? *low : -*high) >= -noise) continue;
    const auto values = corner_values(det);
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (sign * values[k] < -noise) return Fold{piece.corners[k], true};
    }
    if (visited >= most_pieces) return Fold{piece.corners[0], false};
    for (Piece& q : quarters(piece)) stack.push_back(std::move(q));
  }
  return std::nullopt;
}

template <class Polynomial>
Polynomial space_part(Polynomial x, const std::vector<dvec4>& points) {
  double size = 0.0;  // a power of two would do as well; products of coordinates must stay in range
  for (const dvec4& p : points) size = std::max(size, glm::length(dvec3(p)));
  for (std::size_t k = 0; k < points.size(); ++k) x.coefficients[k] = dvec3(points[k]) / size;
  return x;
}

}  // namespace

std::optional<Fold> fold_seen_from_origin(const Net& net) {
  if (const auto* t = std::get_if<TensorNet>(&net)) {
    if (t->m == 0 || t->n == 0) return Fold{};
    return fold_of(TensorPiece{space_part(VectorTensor(t->m, t->n), t->points),
                               {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1), dvec2(1, 1)}});
  }
  const auto& t = std::get<TriangleNet>(net);
  if (t.n == 0) return Fold{};
  return fold_of(
      TrianglePiece{space_part(VectorTriangle(t.n), t.points), {dvec2(1, 0), dvec2(0, 1), dvec2(0, 0)}});
}

}  // namespace rondure
