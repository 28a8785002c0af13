// Ways to a surface normal, right and wrong: what renderers and modellers do at a patch's parameters, and
// what the surface is owed there.
//
// Away from singular points all agree. Where the tangents are parallel, or one of them vanishes, a cross
// product is rounding noise; what stands in for it tells the estimators apart. Each is a function of a patch
// and of parameters in its domain, and knows nothing of families. The result is of unit length, in the
// direction of Su x Sv; there is none where the estimator comes to nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/api/patch.h"
#include "renderer/bezier/common_factor.h"

namespace rondure {

enum class NormalEstimator { limit, cross, cross_float, taylor, shift, hodograph, analytic };

// In the order of the enumeration, as scenes call them.
const std::vector<std::string>& estimator_names();
// The names in quotes, in words.
std::string estimator_list();
std::optional<NormalEstimator> estimator_named(const std::string& name);

using NormalEstimate = std::optional<dvec3>;

// Below this ratio |Su x Sv| / (|Su| |Sv|) `taylor` and `shift` take the tangents for parallel; it is the
// threshold of OpenSubdiv's patch shaders.
inline constexpr double parallel_tangents = 1e-5;

// Su x Sv in double precision, as long as it is not zero.
NormalEstimate cross_normal(const Net& net, double u, double v);

// The same with the control points, the parameters and every operation in single precision.
NormalEstimate cross_float_normal(const Net& net, double u, double v);

// As OpenSubdiv's patch shaders (2017, its issue 947): where the tangents are parallel, the normal's
// derivatives Suu x Sv + Su x Suv and Suv x Sv + Su x Svv, each in the direction that leads inward, are added
// up in its place.
NormalEstimate taylor_normal(const Net& net, double u, double v);

// As SolveSpace (2020, its issue 652) and other modellers: where the tangents are parallel, those of a place
// 1/1024 of the way to the middle of the domain.
inline constexpr double shift_offset = 0x1p-10;
NormalEstimate shift_normal(const Net& net, double u, double v);

// The limit from inside the domain: unit_normal (renderer/bezier/rational.h), and none at a singular point
// where different ways in lead to different normals, as at the tip of a cone. On a collapsed side the limit
// is that along the way on which the parameters of the side stay as they are.
NormalEstimate limit_normal(const Net& net, double u, double v);

// The reduced normal polynomial (Cobb 1988, section 9): no zeros are left on a patch of a quadric.
NormalEstimate hodograph_normal(const ReducedNormal& reduced, double u, double v);

}  // namespace rondure
