// The choice among the patches that circular arcs bound.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/api/surface.h"
#include "renderer/projective/circular_patch.h"

namespace rondure {

inline constexpr long double degrees_per_radian = 57.295779513082320876798154814105L;

// The holonomy's argument up to which a patch of the lower degree counts as existing: arcs may be given in
// doubles, or to ten digits.
inline constexpr long double closes = 1e-10L;

// The roots of the holonomy to try: both, where rounding decides which is the lesser.
std::vector<HolonomyRoot> roots_of(const Complex& holonomy);

// In degrees; 360 where rounding decides whether it is that or -360.
double angle_excess(const Complex& holonomy);

// Whether every corner is straight, at 180 degrees: the holonomy, -1, does not tell this from other corners.
bool all_straight(const std::vector<SphereArc>& arcs);

// "shape": the ratios and turns of the families that have so many, or one number for the first ratio of any;
// nothing where it is not given.
struct GivenShape {
  std::size_t count;  // of numbers
  Shape shape;
};
// `ratios` and `turns` are those of the largest family.
std::optional<GivenShape> read_shape(Params& params, std::size_t ratios, std::size_t turns);
ParameterDoc shape_doc(const std::string& meaning, std::size_t count);

// The image of the first family that is regular and has positive weights only, at the shape given, or with
// all ratios 1 and no turn; else, where none is given, of the first in which a shape of positive weights is
// found; else of the first that is regular. Fails where none is. Notes tell where the first choice failed.
Surface best_image(const Params& params, const std::vector<PreimageFamily>& families,
                   const std::optional<GivenShape>& given);

}  // namespace rondure
