// The "transform" of an object: a 4x4 matrix or a list of steps.
#pragma once

#include "renderer/api/params.h"

namespace rondure {

// "transform": rows of a 4x4 matrix that acts on column vectors, or a list of {"translate": [x, y, z]},
// {"rotate": {"axis": [x, y, z], "angle": degrees}} and {"scale": s or [x, y, z]}, applied in the order
// listed. Identity when absent. A matrix whose last row is (0, 0, 0, w) comes back divided by w, so that
// affine means that the last row is exactly (0, 0, 0, 1). Singular matrices are refused.
dmat4 read_transform(Params& object);

bool is_affine(const dmat4& transform);

// Right-handed, about an axis of any length. Multiples of 90 degrees and coordinate axes give exact zeros and
// ones.
dmat3 rotation(const dvec3& axis, double degrees);

}  // namespace rondure
