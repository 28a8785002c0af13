// Patches of the unit sphere between circular arcs, from preimages under delta (Dietz, Hoschek, Juettler
// 1993, section 3.5).
#pragma once

#include <array>
#include <optional>

#include "renderer/projective/preimage.h"
#include "renderer/projective/shaped_preimage.h"
#include "renderer/projective/spherical_quad.h"
#include "renderer/projective/spinor.h"

namespace rondure {

// Three points of the unit sphere, counter-clockwise seen from outside, and the arcs from each to the next.
struct SphericalTriangle {
  std::array<SphereArc, 3> arc;
};

// What a spinor is multiplied by when it is carried once around the sides. Modulus 1; its argument, in
// (-pi, pi], is half of what the interior angles exceed 2 pi by (quad) or pi (triangle). 1 exactly when these
// arcs bound a patch of degree (2, 2) (theorem 3.9; -1: other arcs of the same circles do) or 2.
Complex holonomy(const SphericalQuad& quad);
Complex holonomy(const SphericalTriangle& triangle);

// Corners 0 to 3 at (u, v) = (0, 0), (1, 0), (1, 1), (0, 1); corners 0 to 2 of a triangle where u, v, w = 1.

// All patches of one construction between given arcs, as preimages with free numbers. They share the surface
// and differ in their parameters and weights.

// Of degree (1, 1): the patch of theorem 3.9. What the holonomy lacks from 1, which should be little, is
// spread over the sides. Free is one ratio, |b00| |b11| / (|b10| |b01|).
PreimageFamily bilinear_family(const SphericalQuad& quad);
TensorPreimage bilinear_preimage(const SphericalQuad& quad, long double shape);

// The same as theorem 3.9's proof makes it, by intersecting planes and projecting lines (lemmas 3.7 and 3.8);
// its shape is as it comes. Nothing where the arcs do not close to a patch, or where circles touch or meet
// again at a corner, so that a plane or a point is not determined.
std::optional<TensorPreimage> bilinear_preimage_by_planes(const SphericalQuad& quad);

// The holonomy is divided among the sides by one of its roots, that of least argument. Near -1 rounding would
// decide which one this is, and it makes another patch, which lies on the other side of the arcs: where they
// run round one circle, or join smoothly, either may be the one that is wanted. `other` is that of the
// argument less a turn, or more.
enum class HolonomyRoot { least, other };

// Of degree (1, 2): the patch of theorem 3.10, for any arcs. The sides at v = 0 and v = 1 are straight, those
// at u = 0 and u = 1 conics, each a straight line l(v) times a linear factor c(v). Free are three ratios,
// |b00| |b12| / (|b10| |b02|) and |c(1)| |l(0)| / (|c(0)| |l(1)|) of the side u = 0 and of u = 1, and a turn:
// what the phases of both factors change by beyond an even division of the holonomy.
PreimageFamily linear_quadratic_family(const SphericalQuad& quad, HolonomyRoot root = HolonomyRoot::least);
TensorPreimage linear_quadratic_preimage(const SphericalQuad& quad, HolonomyRoot root = HolonomyRoot::least);

// The same of degree (2, 1), with conics at v = 0 and v = 1: the ratios are |b00| |b21| / (|b20| |b01|) and
// those of the sides v = 0 and v = 1, along u.
PreimageFamily quadratic_linear_family(const SphericalQuad& quad, HolonomyRoot root = HolonomyRoot::least);
TensorPreimage quadratic_linear_preimage(const SphericalQuad& quad, HolonomyRoot root = HolonomyRoot::least);

// Of degree 1, for a holonomy of 1 or nearly: nothing is free.
PreimageFamily linear_family(const SphericalTriangle& triangle);
TrianglePreimage linear_preimage(const SphericalTriangle& triangle);

// Of degree 2, for any arcs. Free are a ratio of each side, as of those of linear_quadratic_family, from
// corner k to corner k + 1; and two turns: what the phases of the first two sides change by beyond an even
// division. The third makes up for them.
PreimageFamily quadratic_family(const SphericalTriangle& triangle, HolonomyRoot root = HolonomyRoot::least);
TrianglePreimage quadratic_preimage(const SphericalTriangle& triangle,
                                    HolonomyRoot root = HolonomyRoot::least);

}  // namespace rondure
