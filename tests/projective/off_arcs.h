// How far the sides of nets are from circular arcs.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/bezier/bernstein.h"
#include "renderer/bezier/rational.h"
#include "renderer/projective/circular_patch.h"

namespace rondure {

inline lvec3 in_plane(const SphereArc& a) { return glm::normalize(glm::cross(a.q - a.p, a.b - a.w * a.p)); }

// How far the boundary of the net is from the arcs' circles, relative to its largest point, as a polynomial;
// infinite when it runs along the other arc of the circle.
template <class Edge>
double off_circle(const SphereArc& arc, int degree, Edge edge) {
  const lvec3 normal = in_plane(arc);
  const long double height = glm::dot(normal, arc.p);
  long double off = 0, largest = 0;
  dvec4 middle(0.0);
  for (int k = 0; k <= degree; ++k) {
    const dvec4 p = edge(k);
    off = std::max(off, std::abs(glm::dot(normal, lvec3(p)) - height * p.w));
    largest = std::max(largest, static_cast<long double>(glm::length(p)));
    middle += binomial(degree, k) * p;
  }
  // Inside the arc the tangents' meeting point is nearer than the chord's other side.
  const lvec3 m = lvec3(middle) / static_cast<long double>(middle.w);
  const lvec3 chord = glm::normalize(arc.q - arc.p), up = glm::cross(normal, chord);
  const lvec3 arc_middle = (arc.p + arc.q + 2.0L * arc.b) / (2 + 2 * arc.w);
  const bool same_side = glm::dot(up, m - arc.p) * glm::dot(up, arc_middle - arc.p) > 0;
  return same_side ? static_cast<double>(off / largest) : INFINITY;
}

inline double off_circles(const TensorNet& net, const SphericalQuad& quad) {
  const int m = net.m, n = net.n;
  return std::max({off_circle(quad.arc[0], m, [&](int k) { return net.at(k, 0); }),
                   off_circle(quad.arc[1], n, [&](int k) { return net.at(m, k); }),
                   off_circle(quad.arc[2], m, [&](int k) { return net.at(m - k, n); }),
                   off_circle(quad.arc[3], n, [&](int k) { return net.at(0, n - k); })});
}

inline double off_circles(const TriangleNet& net, const SphericalTriangle& triangle) {
  const int n = net.n;
  return std::max({off_circle(triangle.arc[0], n, [&](int k) { return net.at(n - k, k); }),
                   off_circle(triangle.arc[1], n, [&](int k) { return net.at(0, n - k); }),
                   off_circle(triangle.arc[2], n, [&](int k) { return net.at(k, 0); })});
}

inline double off_corners(const Net& net, const SphericalQuad& quad) {
  const std::pair<double, double> at[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  double off = 0.0;
  for (int k = 0; k < 4; ++k)
    off = std::max(off, glm::distance(net_point(net, at[k].first, at[k].second), dvec3(quad.corner(k))));
  return off;
}

}  // namespace rondure
