// The part of the unit sphere below a circle of latitude as one biquartic patch (Cobb 1988, section 5, Table
// 3); z_max = 0 is the hemisphere of Table 2. The four corners, on the circle, are singular: the tangents are
// parallel.
#include <algorithm>
#include <cmath>

#include "renderer/api/registry.h"
#include "renderer/projective/planar_patch.h"
#include "surfaces/families.h"

namespace rondure {
namespace {

// The least middle weight of the disk for which the 25 weights are not negative. The paper's 1 falls short
// from z_max = 1/6 on.
double least_positive_weight(double z) {
  const double inner = (1.0 + 4.0 * z) / (2.0 * (1.0 - z));
  return std::max(z / (1.0 - z), inner > 0.0 ? std::sqrt(inner) : 0.0);
}

// Nearer to the whole sphere the parametrisation is so steep at the pole that grazing hits are lost there.
constexpr double largest_z = 1.0 - 1e-9;

// Within this range hits are within 8 ulps of the sphere, as measured (12 at z = 12/13 with the weight 1, an
// example of the paper's). Below, weights of both signs cancel;
// above, the patch is too steep for parameters that are doubles.
Range accurate_weights(double z) {
  const double inner = std::max(0.0, (1.0 + 4.0 * z) / (2.0 * (1.0 - z)));
  return Range::closed(std::max(1e-3, 0.9 * (std::sqrt(inner) - 4.45)),
                       std::max(1e6, 2.0 * least_positive_weight(z)));
}

Surface build_sphere_cap(Params& params) {
  const double z = params.number("z_max", 0.0, Range{-1.0, largest_z, true, false});
  const double safe = std::max(1.0, 1.125 * least_positive_weight(z));
  const double middle = params.number("middle_weight", safe, accurate_weights(z));
  const long double zl = z;
  const long double radius = 2 * std::sqrt((1 + zl) / (1 - zl));
  Surface surface;
  // Table 3 is 9 (1 - z) times the composition, for integers in it; 1 - z keeps the weights near 8 for any z.
  surface.patches.push_back(sphere_patch(disk(radius, middle), 1 - zl));
  return surface;
}

}  // namespace

void register_sphere_cap(Registry& registry) {
  registry.add(SurfaceFamily{
      "sphere_cap",
      "the unit sphere below z_max as one biquartic patch, singular at its corners (Cobb 1988, section 5, "
      "Table 3)",
      {{"z_max", "number in (-1, 0.999999999]", "0",
        "height of the boundary circle; 0 is the southern hemisphere of Table 2. Above 0.999999 parameters "
        "that are doubles resolve the rim to some 10^-11 radii only, and rays that pass it by less may count "
        "as hits"},
       {"middle_weight", "number in [0.001, 10^6]",
        "max(1, 1.125 times the least that keeps all weights positive)",
        "weight of the planar disk's middle control point; moves parameters, not the surface (the paper has "
        "1). Where the root r of (1 + 4 z_max) / (2 - 2 z_max) is above 4.45, it must be 0.9 (r - 4.45) at "
        "least, for accuracy; where the default is near 10^6 or above, it may be some 1.8 times that"}},
      build_sphere_cap});
}

}  // namespace rondure
