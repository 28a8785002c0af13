// The quadric on which patches lie, found from the patches themselves.
#pragma once

#include <optional>
#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// f(x) = y . A y + 2 b . y + c with y = (x - centre) / scale; A symmetric, or zero on a plane.
struct ImplicitQuadric {
  dvec3 centre{0.0};
  double scale = 1.0;
  dmat3 a{0.0};
  dvec3 b{0.0};
  double c = 0.0;

  double value(const dvec3& x) const;
  dvec3 gradient(const dvec3& x) const;  // with respect to x
  // |f| / |gradient|: the distance from the quadric, to first order. Negative where there is no gradient.
  double distance(const dvec3& x) const;
};

// Signs as in renderer/bezier/rational.h, for the normal along the gradient (direction 1) or against it (-1).
struct QuadricCurvature {
  double gaussian, mean;
};
QuadricCurvature quadric_curvature(const ImplicitQuadric& q, const dvec3& x, double direction);

// The one quadric, or plane, through all points of all these patches; empty when there is none, or no single
// one. Fitted to sampled points: one is accepted when every sample lies within 64 roundoffs of the patches'
// size of it, so it is known as well as the patches themselves. A sphere is recognised and made round.
std::optional<ImplicitQuadric> quadric_through(const std::vector<Net>& patches);

}  // namespace rondure
