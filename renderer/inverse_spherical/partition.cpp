#include "renderer/inverse_spherical/partition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/product.h"
#include "renderer/bezier/triangle.h"
#include "renderer/bezier/triangle_keys.h"
#include "renderer/inverse_spherical/spherical_triangle.h"

namespace rondure {
namespace {

constexpr double on_circle = 1e-9;
// A determinant of unit vectors below this is rounding: 16 units of the last place.
constexpr double flat = 0x1p-48;

struct Index {
  int i, j;
};

class Directions {
 public:
  Directions(int n, const std::vector<dvec3>& u) : n_(n) {
    for (const dvec3& p : u) unit_.push_back(glm::normalize(p));
  }
  const dvec3& at(Index a) const { return unit_[static_cast<std::size_t>(triangle_index(n_, a.i, a.j))]; }
  double turn(Index a, Index b, Index c) const { return orientation(at(a), at(b), at(c)); }
  std::string name(Index a) const { return triangle_key_name(n_, a.i, a.j); }
  int degree() const { return n_; }

 private:
  int n_;
  std::vector<dvec3> unit_;
};

// Point `step` of the side from corner `side` to the next.
Index on_side(int n, int side, int step) {
  if (side == 0) return {n - step, step};
  if (side == 1) return {0, n - step};
  return {step, 0};
}

std::optional<std::string> side_fault(const Directions& d) {
  const int n = d.degree();
  for (int side = 0; side < 3; ++side) {
    const Index from = on_side(n, side, 0), to = on_side(n, side, n);
    const dvec3 normal = glm::normalize(glm::cross(d.at(from), d.at(to)));
    for (int step = 1; step <= n; ++step) {
      const Index here = on_side(n, side, step), before = on_side(n, side, step - 1);
      if (std::abs(glm::dot(d.at(here), normal)) > on_circle) {
        return fmt::format("{} does not lie on the great circle through {} and {}", d.name(here),
                           d.name(from), d.name(to));
      }
      if (glm::dot(glm::cross(d.at(before), d.at(here)), normal) <= flat) {
        return fmt::format("{} does not come after {} on the side from {} to {}", d.name(here),
                           d.name(before), d.name(from), d.name(to));
      }
    }
  }
  return std::nullopt;
}

std::optional<std::string> triangle_fault(const Directions& d, double sign, Index a, Index b, Index c) {
  const double turn = sign * d.turn(a, b, c);
  if (turn > flat) return std::nullopt;
  return fmt::format("the sub-triangle <{}, {}, {}> is {}", d.name(a), d.name(b), d.name(c),
                     turn < -flat ? "inverted, so that it overlaps its neighbours" : "flat");
}

std::optional<std::string> corner_fault(const Directions& d) {
  const int n = d.degree();
  if (std::abs(d.turn({n, 0}, {0, n}, {0, 0})) > flat) return std::nullopt;
  return "the three corners lie on one great circle, and span no spherical triangle";
}

// det(u_a, u_b, u_c) / n^3, of degree 3 (n - 1).
TrianglePolynomial<double> jacobian(int n, const std::vector<dvec3>& u) {
  TrianglePolynomial<dvec3> a(n - 1), b(n - 1), c(n - 1);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n - i; ++j) {
      a.at(i, j) = u[static_cast<std::size_t>(triangle_index(n, i + 1, j))];
      b.at(i, j) = u[static_cast<std::size_t>(triangle_index(n, i, j + 1))];
      c.at(i, j) = u[static_cast<std::size_t>(triangle_index(n, i, j))];
    }
  }
  const auto cross = [](const dvec3& x, const dvec3& y) { return glm::cross(x, y); };
  const auto dot = [](const dvec3& x, const dvec3& y) { return glm::dot(x, y); };
  return multiply(a, multiply(b, c, cross), dot);
}

// A piece of the domain: the net of u over it, and its corners' first two barycentric coordinates.
struct Piece {
  std::vector<dvec3> u;
  std::array<dvec2, 3> corners;
};

std::array<Piece, 4> quarter(const Piece& p, int n) {
  std::array<Piece, 4> out;
  for (Piece& q : out) q.u.resize(p.u.size());
  triangle_quarter(p.u.data(), n, out[0].u.data(), out[1].u.data(), out[2].u.data(), out[3].u.data());
  const dvec2 a = p.corners[0], b = p.corners[1], c = p.corners[2];
  const dvec2 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ac = 0.5 * (a + c);
  out[0].corners = {a, ab, ac};
  out[1].corners = {ab, b, bc};
  out[2].corners = {ac, bc, c};
  out[3].corners = {bc, ac, ab};
  return out;
}

constexpr int most_pieces = 4096;

}  // namespace

std::optional<std::string> partition_fault(int n, const std::vector<dvec3>& u) {
  const Directions d(n, u);
  if (auto fault = corner_fault(d)) return fault;
  if (auto fault = side_fault(d)) return fault;
  const double sign = std::copysign(1.0, d.turn({n, 0}, {0, n}, {0, 0}));
  for (int i = n - 1; i >= 0; --i) {
    for (int j = n - 1 - i; j >= 0; --j) {
      if (auto fault = triangle_fault(d, sign, {i + 1, j}, {i, j + 1}, {i, j})) return fault;
      if (i + j > n - 2) continue;
      // The triangles that point down, in the order that turns as the others do.
      if (auto fault = triangle_fault(d, sign, {i + 1, j + 1}, {i, j + 1}, {i + 1, j})) return fault;
    }
  }
  return std::nullopt;
}

std::optional<std::string> fold_fault(int n, const std::vector<dvec3>& u) {
  const Directions d(n, u);
  if (auto fault = corner_fault(d)) return fault;
  if (auto fault = side_fault(d)) return fault;
  const double sign = std::copysign(1.0, d.turn({n, 0}, {0, n}, {0, 0}));
  double size = 0.0;
  for (const dvec3& p : u) size = std::max(size, glm::length(p));
  std::vector<dvec3> scaled;
  for (const dvec3& p : u) scaled.push_back(sign * p / size);
  std::vector<Piece> stack{{scaled, {dvec2(1, 0), dvec2(0, 1), dvec2(0, 0)}}};
  for (int visited = 0; !stack.empty(); ++visited) {
    const Piece piece = stack.back();
    stack.pop_back();
    const TrianglePolynomial<double> det = jacobian(n, piece.u);
    // The directions of the pieces' own nets shrink by halves; det relative to the greatest of them is what
    // subdivision leaves alone.
    double largest = 0.0;
    for (const double x : det.coefficients) largest = std::max(largest, std::abs(x));
    const double corners[3] = {det.at(det.n, 0), det.at(0, det.n), det.at(0, 0)};
    for (int k = 0; k < 3; ++k) {
      if (corners[k] > flat * largest) continue;
      const dvec2 at = piece.corners[static_cast<std::size_t>(k)];
      return fmt::format(
          "the projection domain folds over, seen from the origin, near the barycentric point ({:.4g}, "
          "{:.4g}, "
          "{:.4g})",
          at.x, at.y, 1.0 - at.x - at.y);
    }
    if (*std::min_element(det.coefficients.begin(), det.coefficients.end()) > 0.0) continue;
    if (visited >= most_pieces) {
      return fmt::format(
          "it cannot be certified that the projection domain does not fold near ({:.4g}, {:.4g})",
          piece.corners[0].x, piece.corners[0].y);
    }
    for (Piece& q : quarter(piece, n)) stack.push_back(std::move(q));
  }
  return std::nullopt;
}

}  // namespace rondure
