// Zeros of a normal polynomial inside a patch: found to rounding, and proved.
#pragma once

#include <optional>

#include "renderer/bezier/curvature_polynomial.h"

namespace rondure {

class ZeroFinder {
 public:
  // `normal` may have lost the factors of its sides; its coefficients are known up to `noise`.
  ZeroFinder(NormalPolynomial normal, double noise);

  // The zero to which Gauss and Newton's method goes from there, as near as rounding lets it; none where it
  // leaves the domain or comes to no zero.
  std::optional<dvec2> from(dvec2 start) const;

  // Whether there is a zero within `within` of the place, and no other within `alone`, whatever the
  // coefficients are within their noise: by Kantorovich's theorem on two of the three coordinates. The third
  // vanishes with them, for N is normal to both tangents. `inside`: the first of these circles is in the
  // domain.
  struct Proof {
    double within = 0.0, alone = 0.0;
    bool inside = false;
  };
  std::optional<Proof> proof(dvec2 at) const;

 private:
  NormalPolynomial normal_, du_, dv_;
  double noise_;
  double size_ = 0.0;    // of the largest coefficient
  double second_ = 0.0;  // bound on the second derivative, as an operator
};

}  // namespace rondure
