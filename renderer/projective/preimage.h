// Bezier nets in projective 3-space and their images on quadrics (Dietz, Hoschek, Juettler 1993, section 2).
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "renderer/bezier/product.h"
#include "renderer/projective/quadric.h"

namespace rondure {

// Control points (p0, p1, p2, p3), with more digits than a double, so that images are rounded only once.
using TensorPreimage = TensorPolynomial<lvec4>;
using TrianglePreimage = TrianglePolynomial<lvec4>;
using Preimage = std::variant<TensorPreimage, TrianglePreimage>;

// A power of two by which to multiply all points of a preimage, which does not change its image: 1 where the
// squares of the largest coordinate are doubles, with room for what is computed from them.
long double squaring_factor(const std::vector<lvec4>& points);

// The image under delta, on the unit sphere: twice the degree.
Net sphere_image(const Preimage& preimage);

// The image on any quadric: under delta, or ruled_image where that is ruled, and then map_to. Coordinates
// that vanish but for rounding are exactly zero.
Net quadric_image(const Preimage& preimage, const Quadric& quadric);

// The other way (theorem 2.2): a preimage under delta of half the degree, unique up to a rotation of phase;
// to about ten digits. Nothing when the net does not lie on the unit sphere, or has a degree that is odd, or
// a factor common to all four coordinates.
std::optional<Preimage> sphere_preimage(const Net& net);

// Where the preimage vanishes, so that the image is no point: parameters (u, v). `ruled`: where the image
// under ruled_image is none, which is where p0 = p1 = 0 or p2 = p3 = 0. At most `limit` are sought. What
// comes within about 1e-9 of the domain from zero counts.
std::vector<dvec2> base_points(const Preimage& preimage, bool ruled, std::size_t limit);

}  // namespace rondure
