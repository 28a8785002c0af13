// Patches of the unit sphere: which of them holds a point, and at which parameters.
//
// Seen from its middle (projected stereographically from the opposite point), a patch is the quotient a / b
// of two complex polynomials in (u, v): for all that spherical constructions make, of half the patch's degree
// (Dietz, Hoschek, Juettler 1993, theorem 2.2). A point of the sphere with the projection z = x / (1 - z3) is
// then where (1 - z3) a - x b vanishes: two real equations of low degree. A grid of cells over the sphere
// (by its largest coordinate and the two others) starts Newton's method so close that two steps reach
// rounding, and knows where a patch fills a cell: there nothing else has to be asked.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/mat3x4.hpp>
#include <optional>
#include <vector>

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
  // The same for one ray whose arithmetic is spread over lanes, lane 2 i + part holding a part (real 0,
  // imaginary 1) of a coefficient of u^i: spread[which][j], `spread_lanes` of them, is what the point's 1 -
  // z, -x and y are multiplied by to make those of u^i v^j.
  alignas(64) std::array<double, 3 * 5 * 16> spread{};

  std::size_t spread_lanes() const { return degree == 2 ? 8 : 16; }
};

struct SpherePatch {
  glm::dmat3x4 axes{0.0};  // to the frame in which the patch's middle is (0, 0, -1); its last row is zero
  std::int32_t inverse = 0;
  bool triangle = false;
  double outward = 1.0;  // -1 where d/du x d/dv points to the middle of the sphere
};

// A patch that is there, with a start for its parameters. Where others may be, or a side is near, only
// parameters inside the domain tell that a point is this patch's.
struct alignas(32) SphereCell {
  // Of 1, a, b, a^2, a b, b^2, a^3, a^2 b, a b^2, b^3 in the cell's coordinates, -1 to 1: for u and v, less
  // the inverse's middle.
  float start[10][2];
  std::int32_t owner;   // -1: none known
  std::int32_t others;  // first of the candidates, this one among them; -1: none, the owner fills the cell
  std::int32_t next;    // the same cell for another patch that is there; -1: no more

  dvec2 start_at(float a, float b) const {
    const float aa = a * a, ab = a * b, bb = b * b;
    const auto at = [&](int k) {
      const auto f = [&](int i) { return start[i][k]; };
      return (((f(0) + f(1) * a) + f(2) * b) + f(4) * ab) +
             ((f(3) + (f(6) * a + f(7) * b)) * aa + (f(5) + (f(8) * a + f(9) * b)) * bb);
    };
    return {at(0), at(1)};
  }
};

struct SphereCandidate {
  std::int32_t patch;  // -1: no more
  float u, v;          // a start, less the middle
};

struct SpherePatches {
  static constexpr std::size_t few = 8;  // so many patches that each has a lane of a register
  std::vector<PatchInverse> inverses;
  std::vector<SpherePatch> patches;  // in the order of their nets
  bool one_kind = true;              // all triangles, or none
  int cells_a_side = 0;
  std::vector<SphereCell> cells;  // [(face * side + row) * side + column], then those that others call next
  std::vector<SphereCandidate> candidates;
  // axes_of_few[3 i + k][p] is axes[i][k] of patch p, where there are no more.
  alignas(64) std::array<std::array<double, few>, 9> axes_of_few{};

  std::size_t bytes() const {
    return sizeof(SpherePatches) + inverses.size() * sizeof(PatchInverse) +
           patches.size() * sizeof(SpherePatch) + cells.size() * sizeof(SphereCell) +
           candidates.size() * sizeof(SphereCandidate);
  }
};

// Of nets on the unit sphere, with positive weights, to `rounding` roundoffs. False when some net has no
// inverse of low enough degree. `known`: for each inverse the net that it is of, in its patch's frame and of
// weight 1 in the middle.
bool build_sphere_patches(const std::vector<Net>& nets, double rounding, int cells_a_side, SpherePatches& out,
                          std::vector<Net>& known);

// The rotation after which nets on the unit sphere have these patches and inverses, as the known nets have
// them that these were made for: to rounding, as congruent patches share an inverse. Nothing when there is
// none.
std::optional<dmat3> turn_onto(const SpherePatches& patches, const std::vector<Net>& known,
                               const std::vector<Net>& nets, double rounding);

// A cell, and the point's place in it.
struct CellPlace {
  std::size_t cell;
  float a, b;  // -1 to 1
};

// Of either coordinate in its face: no point of the sphere has two that are larger than sqrt(1/2).
inline constexpr double cell_reach = 0.7072, cells_per_reach = 0.5 / cell_reach;

// Face 2 k + (negative) of axis k, where that coordinate is the largest; the next two in cyclic order tell
// row and column. Without a branch: nobody can foretell which is the largest.
inline CellPlace cell_at(const dvec3& n, int side) {
  const double middle = 0.5 * side, cells = cells_per_reach * side;
  const double gx = n.x * cells + middle, gy = n.y * cells + middle, gz = n.z * cells + middle;
  const double g[5] = {gx, gy, gz, gx, gy};
  // The largest, which is not asked for, may be negative.
  constexpr int bits = 12;
  constexpr std::uint64_t mask = (1u << bits) - 1;
  const auto whole = [](double a) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(a)) & mask; };
  const std::uint64_t x = whole(gx), y = whole(gy), z = whole(gz);
  const std::uint64_t all = (x | y << bits) | (z << 2 * bits | x << 3 * bits | y << 4 * bits);
  const double size_x = std::fabs(n.x), size_y = std::fabs(n.y), size_z = std::fabs(n.z);
  const auto y_leads = static_cast<unsigned>(size_y > size_x),
             z_leads = static_cast<unsigned>(size_z > std::max(size_x, size_y));
  const unsigned axis = 2 * z_leads | (y_leads & ~z_leads);
  const unsigned negative = static_cast<unsigned>(std::signbit(n.x)) |
                            static_cast<unsigned>(std::signbit(n.y)) << 1 |
                            static_cast<unsigned>(std::signbit(n.z)) << 2;
  const auto face = static_cast<std::size_t>(2 * axis + (negative >> axis & 1u));
  const std::uint64_t mine = all >> (bits * (axis + 1));
  const std::size_t row = mine & mask, column = mine >> bits & mask, width = static_cast<std::size_t>(side);
  const double* from = g + axis + 1;
  return {(face * width + row) * width + column,
          static_cast<float>(2.0 * (from[0] - static_cast<double>(static_cast<std::int64_t>(row))) - 1.0),
          static_cast<float>(2.0 * (from[1] - static_cast<double>(static_cast<std::int64_t>(column))) - 1.0)};
}

// Whether a patch's parameters, less the middle, are in its domain.
inline bool in_domain(const PatchInverse& inverse, bool triangle, dvec2 p) {
  const double u = p.x + inverse.middle.x, v = p.y + inverse.middle.y;
  return u >= 0.0 && v >= 0.0 && (triangle ? u + v : std::max(u, v)) <= 1.0;
}

// Of the patches in a cell the one whose start is in its domain, which is right but beside seams; or else the
// last. `start`: less the middle.
inline const SphereCell& cell_around(const SpherePatches& patches, const CellPlace& at, dvec2& start) {
  const SphereCell* cell = &patches.cells[at.cell];
  for (;;) {
    start = cell->start_at(at.a, at.b);
    if (cell->next < 0) return *cell;
    const SpherePatch& patch = patches.patches[static_cast<std::size_t>(cell->owner)];
    if (in_domain(patches.inverses[static_cast<std::size_t>(patch.inverse)], patch.triangle, start))
      return *cell;
    cell = &patches.cells[static_cast<std::size_t>(cell->next)];
  }
}

// Steps (of sphere_kernel-inl.h) by which the ordinary way finds parameters: one that has gone this far at
// most is the last. What it leaves is of third order, with one factor or another: the product of its parts
// sees one of them, the first alone bounds the other.
inline constexpr int inverse_steps = 2;
inline constexpr double last_parts2 = 1e-32, last_step2 = 2.5e-11;

template <class Stride>
bool has_converged(const Stride& stride, double steepest2) {
  return stride.first2 * stride.second2 <= last_parts2 && stride.first2 <= last_step2 &&
         stride.steep2 <= steepest2;
}

// Newton's method for the parameters (less the middle) at which the patch shows the point n, from a start; at
// most `steps` full steps, or until one is smaller than `enough`. A bound on how far the next step would go:
// the square of the last one, if that was small enough, or else the last one itself.
double invert(const PatchInverse& inverse, const SpherePatch& patch, const dvec3& n, int steps, dvec2& p,
              double enough = 1e-9);

}  // namespace rondure
