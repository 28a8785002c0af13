// Biquadratic planar patches and the biquartic patches of the unit sphere that inverse stereographic
// projection makes of them (Cobb 1988, sections 5 and 6).
#pragma once

#include "renderer/api/patch.h"
#include "renderer/projective/frame.h"

namespace rondure {

// Planar control points (X, Y, W), i along u, j along v; more digits than a double has, so that the net is
// rounded only once.
struct PlanarBiquadratic {
  long double x[3][3], y[3][3], w[3][3];
};

// The disk of the given radius about the origin (Cobb 1988, Table 1), singular at its four corners.
PlanarBiquadratic disk(long double radius, long double middle_weight);

// The square of circular arcs that projects to the cube's face around the south pole (Cobb 1988, Figure 4).
PlanarBiquadratic cube_square(long double middle_weight);

// `scale` times the composition with inverse stereographic projection from the north pole; degree (4, 4).
// Outward where the planar patch has negative orientation, as Cobb's have.
TensorNet sphere_patch(const PlanarBiquadratic& planar, long double scale);

// The same for the projection that a frame describes. Outward where the planar patch has positive
// orientation.
TensorNet sphere_patch(const PlanarBiquadratic& planar, const StereographicFrame& frame);

}  // namespace rondure
