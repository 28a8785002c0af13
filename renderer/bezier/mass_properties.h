// Area, volume, centroid and inertia of a surface, each with a bound on its error.
//
// Everything is in the surface's own frame (Surface::origin apart) and its unit of length; densities are 1.
#pragma once

#include <optional>

#include "renderer/api/surface.h"

namespace rondure {

// A body: the thin shell that the surface is, or the solid that it bounds.
struct Body {
  double measure = 0.0;  // area or volume
  dvec3 centroid{0.0};
  dmat3 inertia{0.0};  // about the centroid: integral of |r|^2 1 - r r^T
  // Bounds on the absolute errors, of any coordinate; infinite where nothing is known.
  double measure_error = 0.0, centroid_error = 0.0, inertia_error = 0.0;
};

struct MassProperties {
  Body shell;
  // Of a closed surface. A negative measure: normals point inward; centroid and inertia are the solid's all
  // the same.
  std::optional<Body> solid;
  // The surface is called closed, and yet its normals do not add up to zero: there is no solid.
  bool leaks = false;
};

// Patches by certified quadrature (renderer/bezier/integration_cell.h), aimed at 1e-13 of the surface's
// extent to the power that fits; the ellipsoid in closed form. At most about 10^5 pieces are integrated, or 8
// a patch where that is more; what is left of the goal then shows in the errors. An ellipsoid's shell has no
// centroid error and its inertia is known for spheres alone (else the error is infinite).
MassProperties mass_properties(const Surface& surface);

}  // namespace rondure
