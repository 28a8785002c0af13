// Random quadrilaterals of circular arcs, and those that nets of projective space bound.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/projective/circular_patch.h"
#include "renderer/projective/frame.h"
#include "tests/bezier/random_nets.h"

namespace rondure {

inline constexpr long double pi = 3.141592653589793238462643383279502884L;

inline lvec3 direction(NetMaker& make) {
  lvec3 d(0);
  while (!(glm::length(d) > 0.1L && glm::length(d) < 1))
    d = {make.uniform(-1, 1), make.uniform(-1, 1), make.uniform(-1, 1)};
  return glm::normalize(d);
}

inline lvec3 image(const lvec4& p) { return lvec3(delta(p)) / delta(p).w; }

// The arc that is the image of the segment from b to c.
inline SphereArc arc_of(const lvec4& b, const lvec4& c) {
  return arc_through(image(b), image(b + c), image(c));
}

inline SphericalQuad quad_of(const TensorPreimage& p) {
  return {{arc_of(p.at(0, 0), p.at(1, 0)), arc_of(p.at(1, 0), p.at(1, 1)), arc_of(p.at(1, 1), p.at(0, 1)),
           arc_of(p.at(0, 1), p.at(0, 0))}};
}

inline TensorPreimage random_bilinear(NetMaker& make) {
  TensorPreimage p(1, 1);
  for (lvec4& c : p.coefficients) c = make.point(-1.0, 1.0);
  return p;
}

// A rather square bilinear net, whose image is regular more often than not.
inline TensorPreimage square_bilinear(NetMaker& make) {
  TensorPreimage p(1, 1);
  for (int i = 0; i <= 1; ++i) {
    for (int j = 0; j <= 1; ++j) {
      const double across = make.uniform(-0.4, 0.4), along = make.uniform(-0.4, 0.4),
                   off = make.uniform(-0.4, 0.4);
      p.at(i, j) = {1, j + across, i + along, off};
    }
  }
  return p;
}

inline bool angles_within(const SphericalQuad& quad, long double least) {
  const auto angles = shape_of(quad, quad.corner(0) + quad.corner(2)).angle;
  return std::all_of(angles.begin(), angles.end(),
                     [&](long double a) { return a > least && a < 180 - least; });
}

// A convex quadrilateral of great circles about a random axis, corners 15 to 75 degrees away from it.
inline SphericalQuad convex_geodesic(NetMaker& make) {
  const StereographicFrame frame(direction(make));
  while (true) {
    std::array<lvec3, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) {
      const long double around = (static_cast<long double>(k) + make.uniform(0.1, 0.9)) * pi / 2;
      const long double away = make.uniform(0.25, 1.3);
      corner[k] = std::cos(away) * frame.centre +
                  std::sin(away) * (std::cos(around) * frame.e1 + std::sin(around) * frame.e2);
    }
    const SphericalQuad quad = geodesic_quad(corner);
    if (angles_within(quad, 10)) return quad;
  }
}

// A quadrilateral of arcs that bulge out or in, angles 5 to 175 degrees.
inline SphericalQuad bulging(NetMaker& make, double most) {
  while (true) {
    SphericalQuad quad = convex_geodesic(make);
    for (SphereArc& arc : quad.arc) {
      const lvec3 middle = glm::normalize(arc.p + arc.q);
      const lvec3 across = glm::cross(arc.p, arc.q);
      const auto by = static_cast<long double>(make.uniform(-most, most));
      arc = arc_through(arc.p, glm::normalize(middle + by * across), arc.q);
    }
    if (angles_within(quad, 5)) return quad;
  }
}

}  // namespace rondure
