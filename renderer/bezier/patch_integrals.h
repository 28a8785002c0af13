// Area and moments of a patch, and the volume of the cone over it, with bounds on their errors.
#pragma once

#include "renderer/api/patch.h"
#include "renderer/bezier/integration_cell.h"

namespace rondure {

// About a given point. Sums over the patches of a closed surface with outward normals give the solid's volume
// (cone.total), first and second moments (divergence theorem), and zero for vector_area.
struct PatchIntegrals {
  MomentSums area, cone;  // over the surface, and over the signed cone between it and the point
  lvec3 vector_area{0.0L};
  OrderErrors area_error{}, cone_error{};  // quadrature and rounding; infinite where the weight may vanish
  int cells = 0;                           // pieces that were needed
};

struct IntegralGoal {
  double error = 0.0;     // of an area, in units of extent^2, of a volume in extent^3, ...
  double extent = 1.0;    // a length: how far the surface reaches from the point
  int most_cells = 4000;  // the patch is subdivided no further, beyond degree 6 earlier; the errors then are
                          // what they are
};

PatchIntegrals integrate_patch(const Net& net, const dvec3& about, const IntegralGoal& goal);

}  // namespace rondure
