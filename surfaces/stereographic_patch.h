// Biquartic patches of the unit sphere from biquadratic planar ones, as sphere_cap and sphere_tiling need
// them.
#pragma once

#include "renderer/api/patch.h"

namespace rondure {

// Planar control points (X, Y, W), i along u, j along v; more digits than a double has, so that the net is
// rounded only once.
struct PlanarBiquadratic {
  long double x[3][3], y[3][3], w[3][3];
};

// The disk of the given radius about the origin (Cobb 1988, Table 1), singular at its four corners.
PlanarBiquadratic disk(long double radius, long double middle_weight);

// `scale` times the composition with inverse stereographic projection; degree (4, 4). Outward where the
// planar patch has negative orientation, as Cobb's have.
TensorNet sphere_patch(const PlanarBiquadratic& planar, long double scale);

}  // namespace rondure
