// Whether a planar rational patch stays inside the domain of another patch's parameters, and does not fold
// over.
#pragma once

#include <optional>

#include "renderer/api/patch.h"

namespace rondure {

// A planar patch is a net of (w x, w y, anything, w).
enum class ParameterDomain { square, triangle };  // [0, 1]^2, or x, y >= 0, x + y <= 1

struct DomainFault {
  bool weight = false;  // the weight is zero or negative there; `point` has no meaning then
  dvec2 point{0.0};     // a point of the patch that is outside
};

// Nothing when the image lies in the closed domain, by control points of one sign after subdivision.
// Excursions below 2^-30, as rounding makes them, pass; so do others that are missed because they are
// narrower than 2^-7 of the patch and less than about 2^-14 of it deep.
std::optional<DomainFault> domain_fault(const Net& planar, ParameterDomain domain);

struct PlanarFold {
  dvec2 left{0.0},
      right{0.0};  // parameters where the patch keeps the orientation of its plane, and where not
};

// Parameters on a grid of 17 x 17 where the Jacobian det(F, F_u, F_v) of F = (w x, w y, w) has both signs,
// beyond rounding; nothing when it has one there, as it has wherever the patch is one-to-one.
std::optional<PlanarFold> planar_fold(const Net& planar);

}  // namespace rondure
