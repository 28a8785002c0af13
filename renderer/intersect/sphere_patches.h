// Patches of the unit sphere: which of them holds a point, and at which parameters.
//
// Seen from its middle (projected stereographically from the opposite point), a patch is the quotient a / b
// of two complex polynomials in (u, v): for all that spherical constructions make, of half the patch's degree
// (Dietz, Hoschek, Juettler 1993, theorem 2.2). A point of the sphere with the projection z = x / (1 - z3) is
// then where (1 - z3) a - x b vanishes: two real equations of low degree. A grid of cells over the sphere (a
// cube's faces, seen from its middle) starts Newton's method so close that two steps reach rounding, and
// knows where a patch fills a cell: there nothing else has to be asked.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/bezier/quotient.h"
#include "renderer/intersect/root.h"

namespace rondure {

// a and b of congruent patches, in powers of (u, v) - middle: coefficients[4 (i (degree + 1) + j)] and the
// next three are the real and imaginary parts of a's and b's coefficients of u^i v^j.
struct PatchInverse {
  int degree = 0;  // 2 or 4, the size of the arrays: coefficients beyond the patch's own are zero
  dvec2 middle{0.0};
  // Square of how far rounding may move the parameters, of which more is left to a slower and more careful
  // way: near points where the patch is singular.
  double steepest2 = 0.0;
  std::array<double, 100> coefficients{};
};

struct SpherePatch {
  dvec3 axes[3];  // rows: to the frame in which the patch's middle is (0, 0, -1)
  std::int32_t inverse = 0;
  std::int32_t patch = 0;  // of the surface
  bool triangle = false;
  double outward = 1.0;  // -1 where d/du x d/dv points to the middle of the sphere
  NetScale scale;        // of the surface's net
};

// A patch that is there, with a start for its parameters. Where others may be, or a side is near, only
// parameters inside the domain tell that a point is this patch's.
struct SphereCell {
  float u[6], v[6];    // 1, a, b, a^2, a b, b^2 in the cell's coordinates, -1 to 1: less the inverse's middle
  std::int32_t owner;  // -1: none known
  std::int32_t others;  // first of the candidates, this one among them; -1: none, the owner fills the cell
};

struct SphereCandidate {
  std::int32_t patch;  // -1: no more
  float u, v;          // a start, less the middle
};

struct SpherePatches {
  std::vector<PatchInverse> inverses;
  std::vector<SpherePatch> patches;
  int cells_a_side = 0;
  std::vector<SphereCell> cells;  // [(face * side + row) * side + column]
  std::vector<SphereCandidate> candidates;

  std::size_t bytes() const {
    return inverses.size() * sizeof(PatchInverse) + patches.size() * sizeof(SpherePatch) +
           cells.size() * sizeof(SphereCell) + candidates.size() * sizeof(SphereCandidate);
  }
};

// Of nets on the unit sphere, with positive weights; `which[k]` is what net k is called in the surface and
// `scales[k]` its scale there. False when some net has no inverse of low enough degree.
bool build_sphere_patches(const std::vector<Net>& nets, const std::vector<std::size_t>& which,
                          const std::vector<NetScale>& scales, int cells_a_side, SpherePatches& out);

// A cell, and the point's place in it.
struct CellPlace {
  std::size_t cell;
  double a, b;  // -1 to 1
};

// Face 2 k + (negative) of axis k; the next two axes in cyclic order are the coordinates.
inline CellPlace cell_at(const dvec3& n, int side) {
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  const bool is_x = x >= y && x >= z, is_y = !is_x && y >= z;
  const double major = is_x   ? n.x
                       : is_y ? n.y
                              : n.z,
               second = is_x   ? n.y
                        : is_y ? n.z
                               : n.x,
               third = is_x   ? n.z
                       : is_y ? n.x
                              : n.y;
  const int face = (is_x ? 0 : is_y ? 2 : 4) + (major < 0.0 ? 1 : 0);
  const double r = quotient(1.0, std::fabs(major)), half = 0.5 * side;
  const double g = (second * r + 1.0) * half, h = (third * r + 1.0) * half;
  const int row = std::min(static_cast<int>(g), side - 1), column = std::min(static_cast<int>(h), side - 1);
  return {static_cast<std::size_t>((face * side + row) * side + column), 2.0 * (g - row) - 1.0,
          2.0 * (h - column) - 1.0};
}

// Newton's method for the parameters (less the middle) at which the patch shows the point n, from a start; at
// most `steps` full steps. How far the last step went: below 1e-12 it has converged.
double invert(const PatchInverse& inverse, const SpherePatch& patch, const dvec3& n, int steps, dvec2& p);

}  // namespace rondure
