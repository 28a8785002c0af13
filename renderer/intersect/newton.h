// Newton's method on one leaf, with a proof of what it finds.
//
// With J the Jacobian of the projected pair at the leaf's centre and M >= |J^-1| |J(p) - J| over the enlarged
// leaf (from the leaf's spreads), a root p* in the leaf satisfies |p* - p1| <= M |p*| for the first Newton
// iterate p1. So p1 too far outside proves that there is no root; and if the row sums of M are below 1/3,
// there is at most one, and full Newton steps from p1 stay in the enlarged leaf and converge to it (Krawczyk
// 1969). Otherwise the ray grazes the leaf, or the leaf touches a singular point: undecided, and `clipping`
// has to look.
#pragma once

#include "renderer/intersect/leaf.h"

namespace rondure {

enum class NewtonVerdict { none, root, undecided };

struct NewtonCounts {
  std::size_t leaves = 0;     // leaf tests
  std::size_t iterated = 0;   // of these, those that went past the linear rejection
  std::size_t steps = 0;      // evaluations of the patch
  std::size_t undecided = 0;  // handed to clipping
};

// `root` is set, in the patch's parameters, when the verdict is `root`; rounding may have put it outside the
// patch.
NewtonVerdict newton_on_leaf(const Leaf& leaf, const Net& net, const LocalRay& ray, double error, Root& root,
                             NewtonCounts& counts) noexcept;

}  // namespace rondure
