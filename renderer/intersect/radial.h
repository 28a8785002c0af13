// Rays against inverse spherical surfaces with planar projection domains, in one unknown.
//
// With the corners T_1, T_2, T_3 of the domain as columns of a matrix, b = T^-1 p are the coordinates of p in
// them and h = b_1 + b_2 + b_3. The patch is the set of p with b >= 0 and W(b) = h^(n-1), where W is the
// weights' form of degree n (Casciola and Morigi 2004, section 5: S(u) = u / w(u) on the plane h = 1). Along
// a ray b is linear in t, so that this is a polynomial of degree n, and all its coefficients are sums of
// positive products. Its roots in the part of the ray with b >= 0 and h between the reciprocals of the
// weights are all that the patch and the ray have in common; the parameters are b / h.
#pragma once

#include <vector>

#include "renderer/intersect/leaf.h"

namespace rondure {

// A piece of a patch: a sub-triangle of its domain has a form of its own, with a tighter box and bounds.
struct RadialPiece {
  int n = 0;
  dmat3 rows{1.0};               // T^-1, row i as a column, so that b_i = rows[i] . p
  dvec3 rounding{0.0};           // bounds on the error of b_i, at points no further away than the piece
  double low = 0.0, high = 0.0;  // bounds of h on the piece
  double roundoffs = 0.0;  // error of the polynomial's coefficients, relative to the sums they consist of
  double extent = 0.0;     // greatest |p| on the piece
  std::vector<double> weights;  // w_ijk n! / (i! j! k!), in triangle_index order
};

// Whether a net has this form: control vectors (wx, wy, wz) that divide their plane triangle evenly, to
// rounding, positive weights, and corners far enough from a plane through the origin.
bool has_radial_form(const Net& net);

// Adds the 4^depth pieces of such a net, and their leaves, of which only place, patch and scale are set.
void add_radial_leaves(const Net& net, int patch, int depth, LeafSet& set, std::vector<RadialPiece>& pieces);

// Adds the roots of the ray on the piece, settled. `net` is the whole patch.
void solve_radial(const RadialPiece& piece, const Leaf& leaf, const Net& net, const LocalRay& ray,
                  std::vector<Root>& roots) noexcept;

}  // namespace rondure
