// A quadrilateral of circular arcs on the unit sphere as one biquartic patch: the general tool of Cobb (1988,
// section 7).
#pragma once

#include "renderer/api/patch.h"
#include "renderer/projective/planar_patch.h"
#include "renderer/projective/spherical_quad.h"

namespace rondure {

// Weights of the planar patch's corners: 1, as the paper has them; or 1 + cos of the angle from the centre (1
// - z in the paper's position), with which every edge is the symmetric quadratic arc times a factor, so that
// two patches agree along a common edge point by point, whatever their centres.
enum class CornerWeights { unit, matched };

struct QuadPatchOptions {
  lvec3 centre;  // of projection, not zero
  CornerWeights corner_weights = CornerWeights::matched;
  // Of the planar patch's middle control point, in units of the mean weight of its corners.
  long double middle_weight = 1;
  // Doubles the middle weight until the patch is certainly regular. A large enough weight always does when
  // defect_of finds nothing; no quadrilateral is known for which 1 falls short.
  bool may_double = true;
  bool straight_corners = false;  // as in defect_of
};

struct QuadPatch {
  TensorNet net;  // (0,0), (1,0), (1,1), (0,1) are corners 0 to 3; outward
  int doublings;  // of the middle weight
  bool regular;   // certainly; false when the weight does not suffice and may not be doubled any more
};

// `quad` must have no defect about the centre. The middle control point is where the diagonals meet.
QuadPatch quad_patch(const SphericalQuad& quad, const QuadPatchOptions& options);

}  // namespace rondure
