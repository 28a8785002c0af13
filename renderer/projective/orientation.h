// Where the image of a preimage under delta is regular.
#pragma once

#include "renderer/projective/preimage.h"

namespace rondure {

// J of f_u x f_v = J f / w^2, f the point of the unit sphere: J > 0 where the patch faces outward. Degree
// (4m - 2, 4n - 2) for a tensor preimage of degree (m, n), m, n >= 1; 4n - 2 for a triangular one.
TensorPolynomial<long double> orientation(const TensorPreimage& preimage);
TrianglePolynomial<long double> orientation(const TrianglePreimage& preimage);

struct PreimageRegularity {
  bool regular;       // J > 0 certainly, but for corners and edges where it may be zero
  dvec2 worst;        // otherwise: parameters where it is not, or cannot be told
  bool flat = false;  // J vanishes everywhere, but for rounding: the image is a curve, or a point
};
PreimageRegularity regularity(const Preimage& preimage);

}  // namespace rondure
