#include "renderer/complex/shipped.h"

#include <cmath>

#include "renderer/bezier/index.h"
#include "renderer/complex/regular_joins.h"

namespace rondure {
namespace {

// Glues edges whose ends are the same two of the numbered vertices. Every pair must be there at most twice.
std::vector<Gluing> glue_by_vertices(const std::vector<std::vector<int>>& corners) {
  std::vector<Gluing> gluings;
  struct Side {
    EdgeRef edge;
    int from, to;
  };
  std::vector<Side> open;
  for (std::size_t p = 0; p < corners.size(); ++p) {
    const int sides = static_cast<int>(corners[p].size());
    for (int e = 0; e < sides; ++e) {
      const Side side{{static_cast<int>(p), e}, corners[p][index(e)], corners[p][index((e + 1) % sides)]};
      bool glued = false;
      for (std::size_t k = 0; k < open.size() && !glued; ++k) {
        const bool reversed = open[k].from == side.to && open[k].to == side.from;
        if (!reversed && !(open[k].from == side.from && open[k].to == side.to)) continue;
        gluings.push_back({open[k].edge, side.edge, reversed});
        open.erase(open.begin() + static_cast<std::ptrdiff_t>(k));
        glued = true;
      }
      if (!glued) open.push_back(side);
    }
  }
  return gluings;
}

}  // namespace

SurfaceComplex octahedron_complex() {
  SurfaceComplex complex;
  complex.sides.assign(8, 3);
  // xi(X) points from X to the opposite corner: inward - s along.
  const EdgeField to_corner{EdgeFunction(linear(0, -1)), EdgeFunction(1)};
  // Edges PQ, QR, RP are crossed by changing the sign of the third, first, second axis.
  constexpr int bit[3] = {1, 4, 2};
  for (int p = 0; p < 8; ++p) {
    for (int e = 0; e < 3; ++e) {
      const int q = p ^ bit[e];
      if (q < p) continue;
      complex.joins.push_back(join_by_fields({p, e}, {q, e}, edge_parameter(false), to_corner, to_corner));
    }
  }
  return complex;
}

std::vector<std::vector<std::array<double, 3>>> cube_corners() {
  std::vector<std::vector<std::array<double, 3>>> faces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
      const std::size_t u = side == 1 ? b : c, v = side == 1 ? c : b;
      std::vector<std::array<double, 3>> face;
      for (int k = 0; k < 4; ++k) {
        std::array<double, 3> p{};
        p[axis] = 2.0 * side - 1.0;
        p[u] = 2.0 * corner_point(4, k)[0] - 1.0;
        p[v] = 2.0 * corner_point(4, k)[1] - 1.0;
        face.push_back(p);
      }
      faces.push_back(face);
    }
  }
  return faces;
}

SurfaceComplex cube_complex() {
  std::vector<std::vector<int>> corners;
  for (const auto& face : cube_corners()) {
    std::vector<int> numbers;
    for (const auto& p : face)
      numbers.push_back((p[0] > 0 ? 1 : 0) + (p[1] > 0 ? 2 : 0) + (p[2] > 0 ? 4 : 0));
    corners.push_back(numbers);
  }
  return regular_complex(std::vector<int>(6, 4), glue_by_vertices(corners));
}

// The rhombus about the lattice edge from a to b has these, and the centres of the triangles right and left
// of it, as corners: a, right, b, left.
std::vector<std::vector<std::array<double, 2>>> torus_corners(int k, int l) {
  std::vector<std::vector<std::array<double, 2>>> out;
  constexpr double third = 1.0 / 3.0;
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j < l; ++j) {
      const double x = i, y = j;
      const std::array<double, 2> a{x, y};
      const auto at = [&](double dx, double dy) { return std::array<double, 2>{x + dx, y + dy}; };
      out.push_back({a, at(2 * third, -third), at(1, 0), at(third, third)});
      out.push_back({a, at(third, third), at(0, 1), at(-third, 2 * third)});
      out.push_back({at(1, 0), at(2 * third, 2 * third), at(0, 1), at(third, third)});
    }
  }
  return out;
}

// Edges are glued one by one: with few cells a pair of vertices has several edges.
SurfaceComplex torus_complex(int k, int l) {
  std::vector<Gluing> gluings;
  const auto polygon = [&](int i, int j, int kind) {
    return 3 * (((i % k + k) % k) * l + (j % l + l) % l) + kind;
  };
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j < l; ++j) {
      const int a = polygon(i, j, 0), b = polygon(i, j, 1), c = polygon(i, j, 2);
      // Around the centre of the cell's lower triangle, corners 3, 1 and 3 of its three rhombi.
      gluings.push_back({{a, 3}, {b, 0}, true});
      gluings.push_back({{b, 1}, {c, 2}, true});
      gluings.push_back({{c, 3}, {a, 2}, true});
      // And of its upper triangle, with the rhombi of the next cells.
      gluings.push_back({{c, 0}, {polygon(i + 1, j, 1), 3}, true});
      gluings.push_back({{polygon(i + 1, j, 1), 2}, {polygon(i, j + 1, 0), 1}, true});
      gluings.push_back({{polygon(i, j + 1, 0), 0}, {c, 1}, true});
    }
  }
  return regular_complex(std::vector<int>(static_cast<std::size_t>(3 * k * l), 4), gluings);
}

}  // namespace rondure
