// Quadrics: what a symmetric matrix describes, and the projective maps that make rational patches of the
// sphere or of its ruled counterpart into patches of any quadric (Dietz, Hoschek, Juettler 1993, section 2.3
// and conclusion).
#pragma once

#include <string>
#include <variant>

#include "renderer/api/patch.h"
#include "renderer/projective/generalised_projection.h"

namespace rondure {

// With semi-axes a, b, c, in its own frame:
enum class QuadricKind {
  ellipsoid,              // x^2/a^2 + y^2/b^2 + z^2/c^2 = 1
  two_sheets,             // z^2/c^2 - x^2/a^2 - y^2/b^2 = 1, a hyperboloid
  one_sheet,              // x^2/a^2 + y^2/b^2 - z^2/c^2 = 1, a hyperboloid
  elliptic_paraboloid,    // z/c = x^2/a^2 + y^2/b^2
  hyperbolic_paraboloid,  // z/c = x^2/a^2 - y^2/b^2
};

// Whether it carries straight lines, and so is no image of the sphere.
inline bool is_ruled(QuadricKind kind) {
  return kind == QuadricKind::one_sheet || kind == QuadricKind::hyperbolic_paraboloid;
}

struct Quadric {
  QuadricKind kind;
  lvec3 semi_axes;  // positive
  lmat4 frame;      // rigid, from its own frame to the world's
};

// B of x^T B x = 0, x = (x, y, z, w), up to a factor.
lmat4 matrix_of(const Quadric& quadric);

// The quadric of a symmetric matrix. A text when it is none of the five kinds: "an elliptic cone", "a
// parabolic cylinder", "a pair of planes", "an imaginary ellipsoid" and so on. Of a paraboloid c = 1. The
// axes are sorted by length, those of one sign together; numbers below 1e-12 of the largest count as zero.
std::variant<Quadric, std::string> classify(const lmat4& matrix);

// Maps the unit sphere (not ruled) to the quadric, or the surface of ruled_image (ruled). The sphere's
// southern hemisphere becomes the sheet of two_sheets at z > 0; its point (0, 0, 1) goes to infinity on
// elliptic_paraboloid.
lmat4 map_to(const Quadric& quadric);

// The hyperbolic counterpart of delta, as a symmetric bilinear form: onto x^2 + y^2 = z^2 + w^2, equation
// (38). Straight lines where p0, p1 or p2, p3 are constant.
inline lvec4 ruled_image(const lvec4& p, const lvec4& q) {
  const auto product = [&](int i, int j) { return (p[i] * q[j] + p[j] * q[i]) / 2; };
  return {product(0, 3) - product(1, 2), product(1, 3) + product(0, 2), product(1, 3) - product(0, 2),
          product(0, 3) + product(1, 2)};
}

}  // namespace rondure
