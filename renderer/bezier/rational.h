// The rational surface of a control net: points, derivatives, normals, curvature. Parameters as in
// api/patch.h.
#pragma once

#include "renderer/api/patch.h"
#include "renderer/bezier/tensor.h"

namespace rondure {

// The homogeneous polynomial (wx, wy, wz, w) and its derivatives; compile-time degrees where they are common.
FirstOrder<dvec4> net_first(const Net& net, double u, double v);
SecondOrder<dvec4> net_second(const Net& net, double u, double v);

dvec3 net_point(const Net& net, double u, double v);

// The point in space and its derivatives with respect to (u, v).
struct SurfaceJet {
  dvec3 point, du, dv, duu, duv, dvv;
};
SurfaceJet surface_jet(const Net& net, double u, double v);

// d/du x d/dv, normalised. Where that vanishes (a corner with parallel tangents, a collapsed edge) the limit
// from inside the domain, taken from the Bernstein form of the normal polynomial: there the terms that vanish
// are exactly zero and the rest does not cancel, so the direction stays good beside the singularity too. Zero
// where the surface has no normal at all.
dvec3 unit_normal(const Net& net, double u, double v);
// The same where net_first(net, u, v) is at hand already.
dvec3 unit_normal(const Net& net, double u, double v, const FirstOrder<dvec4>& first);

// Signs as for f_uu . n with the normal above: an outward sphere of radius r has mean curvature -1 / r. At a
// singular point the values are those of a point a little further inside (about 1e-4 of the domain).
struct Curvature {
  double gaussian, mean;
};
Curvature curvature(const Net& net, double u, double v);

}  // namespace rondure
