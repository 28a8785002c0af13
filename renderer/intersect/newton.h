// Newton's method on one leaf, with a proof of what it finds.
//
// In the leaf's frame (leaf.h) a ray is its slope s and the point p0 where it meets the plane zeta = 0, and
// its roots are those of equation (1) there.
//
// None: a root p in the leaf satisfies |p - (p0 + s middle_zeta)| <= bound + |s| bound_zeta + |p0|
// bound_weight, so that a ray too far outside has none.
//
// One: for two points p and q of the enlarged leaf, the left sides of (1) differ by (A - s g^T)(p - q), where
// A differs from I by at most e = slack + |p0| slack_weight in the maximum norm and |g| <= slack_zeta, which
// are bounds over a convex set. As det(A - s g^T) = det A (1 - g^T A^-1 s) and |A^-1 s - s| <= |s| e / (1 -
// e), that is regular, and there is one root at most, if e < 1 and
//     |s| . slack_zeta + |s| (sum of slack_zeta) e / (1 - e) < 1,
// the second |s| being the larger component. Where Newton's method ends in the enlarged leaf, in the leaf or
// beside it, is then where the root is. The method starts from where the ray meets the leaf's osculating
// paraboloid, so that one or two steps are usual.
//
// Otherwise the ray grazes the leaf, or the leaf touches a singular point. If it stays further from the
// leaf's osculating paraboloid than any point of the leaf is, there is none after all; else it is undecided,
// and `clipping` has to look.
#pragma once

#include "renderer/intersect/instructions.h"
#include "renderer/intersect/leaf.h"

namespace rondure {

namespace newton_limits {

// Of what must be below 1 for there to be one root at most: somewhat below, Newton's method finds it.
inline constexpr double uniqueness = 0.9;
inline constexpr double straight = 0.5;
// Below 1/3 the distance from a root of the leaf cannot grow in a step.
inline constexpr double contraction = 0.3;
// So short a step from where the second derivatives are known, and then one so short: the third derivatives,
// a hundredth or so in a leaf's parameters, do not count.
inline constexpr double longest_bent = 0x1p-9, longest_moved = 0x1p-38;

}  // namespace newton_limits

enum class NewtonVerdict { none, root, undecided };

struct NewtonCounts {
  std::size_t leaves = 0;     // leaf tests
  std::size_t iterated = 0;   // of these, those that went past the linear rejection
  std::size_t steps = 0;      // evaluations of the patch
  std::size_t undecided = 0;  // handed to clipping
};

// A root in the patch's parameters, and the patch there.
struct NewtonRoot {
  Root root;
  FirstOrder<dvec4> surface;
};

// What the method needs of a patch, whose net must stay where it is.
struct NewtonPatch {
  const dvec4* points = nullptr;
  int m = 0, n = 0;  // degrees along u and v; of a triangle, its degree and -1
  double noise =
      0.0;  // a bound on normal_noise (regular_normal.h) everywhere, in units of a component's size
  // `out` is set when the verdict is `root`; rounding may have put it outside the patch. `error`:
  // residual_bound of the leaf.
  NewtonVerdict (*on_leaf)(const Leaf& leaf, const NewtonPatch& patch, const LocalRay& ray, double error,
                           NewtonRoot& out, NewtonCounts& counts) noexcept = nullptr;

  bool is_rectangle() const { return n >= 0; }
};

// By the best instructions that the machine has, or by these.
NewtonPatch newton_patch(const Net& net);
NewtonPatch newton_patch(const Net& net, Instructions set);

}  // namespace rondure
