// Where a planar rational patch is regular.
#pragma once

#include <optional>

#include "renderer/bezier/product.h"
#include "renderer/projective/planar_patch.h"

namespace rondure {

// det(F, F_u, F_v) of F = (X, Y, W), in its true degree (4, 4): the Jacobian of the map (u, v) -> (X / W,
// Y / W) times W^3.
TensorPolynomial<long double> planar_jacobian(const PlanarBiquadratic& planar);

// Whether no Bernstein coefficient is negative and those of the corners are positive: a proof that the patch
// is regular with positive orientation. Coefficients within rounding of zero pass, those of the corners only
// where `straight_corners` admits angles of 180 degrees.
bool certainly_regular(const PlanarBiquadratic& planar, bool straight_corners);

// Doubles the weight of the middle control point until the patch is certainly regular, and returns how often
// that was; nothing after `most` times in vain. The Jacobian is D0 + weight D1, so that a large weight
// decides wherever D1 does.
std::optional<int> double_until_regular(PlanarBiquadratic& planar, bool straight_corners, int most);

}  // namespace rondure
