// Patches between plane sections of ruled quadrics: what theorems 3.9 and 3.10 (Dietz, Hoschek, Juettler
// 1993) become when delta is replaced by ruled_image. A pair of real numbers takes the place of a complex
// one.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>

#include "renderer/projective/preimage.h"

namespace rondure {

using lvec2 = glm::vec<2, long double, glm::defaultp>;

// A preimage p = (a0, a1, b1, b0). Each of a and b, up to a factor, names a straight line of the quadric; the
// point is where they meet.
struct RuledPoint {
  lvec2 a, b;
};
lvec4 to_preimage(const RuledPoint& p);
// The point of x^2 + y^2 = z^2 + w^2, as the image of (a of p, b of q) when p and q differ.
lvec4 ruled_point(const lvec2& a, const lvec2& b);
// a and b of length 1; of the point nearest to x in some sense, where that is a little off the quadric.
RuledPoint ruled_preimage(const lvec4& x);

// The image of the segment from p to (a.x q.a, a.y q.b) is an arc of a plane section from p to q: for each
// plane through both there is one ratio of a.x and a.y, and for the other arc both have the other sign. A
// common positive factor moves parameters only; here |a.x a.y| = 1.
using SectionArc = lvec2;

// Passing through r, which lies on no straight line with p or q.
SectionArc section_through(const RuledPoint& p, const RuledPoint& r, const RuledPoint& q);

// In the plane h . (x, y, z, w) = 0, which contains p and q: the arc along which `weight` . (x, y, z, w) has
// no zero; if neither has, the one with the greater weight in the middle, which is the shorter. Where p and q
// lie on one straight line, that. Nothing where both arcs have a zero, or the plane touches the quadric at p
// or q.
std::optional<SectionArc> section_in_plane(const RuledPoint& p, const RuledPoint& q, const lvec4& h,
                                           const lvec4& weight);

struct RuledQuad {
  std::array<RuledPoint, 4> corner;
  std::array<SectionArc, 4> arc;  // from each corner to the next
};

// What both coordinates are multiplied by around the sides. Both positive where the sides bound a region.
// Equal exactly where a patch of degree (2, 2) exists: corners 0 and 2 lie in a plane with the points where
// the sections of corners 1 and 3 meet again.
lvec2 holonomy(const RuledQuad& quad);

// Corners 0 to 3 at (u, v) = (0, 0), (1, 0), (1, 1), (0, 1); the holonomy must be positive.
TensorPreimage bilinear_preimage(const RuledQuad& quad);          // holonomy equal, but for rounding
TensorPreimage linear_quadratic_preimage(const RuledQuad& quad);  // any: degree (1, 2)
TensorPreimage quadratic_linear_preimage(const RuledQuad& quad);  // (2, 1)

// Whether the image under ruled_image is certainly regular inside.
bool is_regular_ruled(const TensorPreimage& preimage);

}  // namespace rondure
