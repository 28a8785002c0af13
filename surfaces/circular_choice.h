// The choice among the patches that circular arcs bound.
#pragma once

#include <vector>

#include "renderer/api/surface.h"
#include "renderer/projective/circular_patch.h"

namespace rondure {

inline constexpr long double degrees_per_radian = 57.295779513082320876798154814105L;

// The holonomy's argument up to which a patch of the lower degree counts as existing: arcs may be given in
// doubles, or to ten digits.
inline constexpr long double closes = 1e-10L;

// The roots of the holonomy to try: both, where rounding decides which is the lesser.
std::vector<Root> roots_of(const Complex& holonomy);

// Whether every corner is straight, at 180 degrees: the holonomy, -1, does not tell this from other corners.
bool all_straight(const std::vector<SphereArc>& arcs);

// The image of the first candidate that is regular and has positive weights only, or else of the first that
// is regular. Fails where none is.
Surface best_image(const Params& params, const std::vector<Preimage>& candidates);

}  // namespace rondure
