#include "renderer/inverse_spherical/partition.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/star_shaped.h"
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
  TriangleNet domain(n);
  for (std::size_t k = 0; k < u.size(); ++k) domain.points[k] = dvec4(u[k], 1.0);
  const std::optional<Fold> fold = fold_seen_from_origin(domain);
  if (!fold) return std::nullopt;
  const dvec2 at = fold->at;
  if (!fold->certain) {
    return fmt::format(
        "it cannot be certified that the projection domain does not fold near ({:.4g}, {:.4g})", at.x, at.y);
  }
  return fmt::format(
      "the projection domain folds over, seen from the origin, near the barycentric point ({:.4g}, {:.4g}, "
      "{:.4g})",
      at.x, at.y, 1.0 - at.x - at.y);
}

}  // namespace rondure
