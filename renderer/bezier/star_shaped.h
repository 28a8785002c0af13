// Whether a patch turns back as seen from the origin.
#pragma once

#include <optional>

#include "renderer/api/patch.h"

namespace rondure {

struct Fold {
  dvec2 at{0.0};        // parameters near which the patch turns back
  bool certain = true;  // false: within the subdivisions allowed, neither this nor the contrary was shown
};

// Empty when it does not: det(X, X_u, X_v) of the homogeneous (X, w), which is w^3 times p . (p_u x p_v),
// keeps one sign, by its Bernstein coefficients after finitely many subdivisions and to their rounding. Zeros
// at the boundary, at singular corners and collapsed sides, do no harm. Then directions from the origin are
// regular parameters of the patch; two points in one direction remain possible where it winds around the
// origin. Weights must be positive. A patch in a plane through the origin folds everywhere.
std::optional<Fold> fold_seen_from_origin(const Net& net);

}  // namespace rondure
