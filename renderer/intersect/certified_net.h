// A piece of a patch seen along a ray: Bernstein coefficients, and one bound on all of their errors.
//
// Only two operations touch the coefficients: the mean of two, which adds one rounding, and an affine
// combination, which adds three. Convex combinations pass errors on without enlarging them.
#pragma once

#include <algorithm>
#include <vector>

#include "renderer/bezier/bernstein.h"
#include "renderer/intersect/certified_ray.h"
#include "renderer/intersect/enclosure.h"

namespace rondure {

// A rectangle's or a triangle's degrees. Edges, along which a piece is halved: 0 and 1 along u and v; or 0,
// 1, 2 of a triangle, from u = 1 to v = 1, on to u = v = 0, and back.
struct NetShape {
  bool triangle = false;
  int m = 0, n = 0;  // of a triangle m = n

  int edges() const { return triangle ? 3 : 2; }
  int at(int i, int j) const { return triangle ? triangle_index(n, i, j) : i * (n + 1) + j; }
  int degree(int edge) const { return triangle || edge == 1 ? n : m; }

  // visit(places, count): the coefficients along each line that follows the edge, from its start.
  template <class Visit>
  void for_lines(int edge, const Visit& visit) const {
    int places[max_degree + 1];
    if (!triangle) {
      for (int k = 0; k <= (edge == 0 ? n : m); ++k) {
        for (int l = 0; l <= degree(edge); ++l) places[l] = edge == 0 ? at(l, k) : at(k, l);
        visit(places, degree(edge) + 1);
      }
      return;
    }
    for (int fixed = 0; fixed <= n; ++fixed) {
      for (int l = 0; l <= n - fixed; ++l) {
        const int from = n - fixed - l;
        places[l] = edge == 0 ? at(from, l) : edge == 1 ? at(fixed, from) : at(l, fixed);
      }
      visit(places, n - fixed + 1);
    }
  }
};

inline NetShape shape_of(const Net& net) {
  if (const auto* tensor = std::get_if<TensorNet>(&net)) return {false, tensor->m, tensor->n};
  const int n = std::get<TriangleNet>(net).n;
  return {true, n, n};
}

// Powers of two that f, g and h, and w, are counted in, so that their sizes are 1: errors are then small for
// all of them.
struct CertifiedUnits {
  int position = 0, weight = 0;

  // Of h / w.
  int ratio() const { return position - weight; }
};

// Local parameters (a, b) of the piece: [0, 1]^2, or a, b >= 0, a + b <= 1; (u, v) = origin + a along_a + b
// along_b. The piece is exactly where these doubles say, as long as it is made by fewer than 50 halvings.
template <class T>
struct CertifiedPiece {
  NetShape shape;
  std::vector<RayPoint<T>> c;
  T error = 0;  // of every f, g, h and w
  CertifiedUnits units;
  dvec2 origin{0.0}, along_a{1.0, 0.0}, along_b{0.0, 1.0};

  dvec2 to_patch(dvec2 p) const { return origin + p.x * along_a + p.y * along_b; }
  dvec2 middle() const { return dvec2(shape.triangle ? 1.0 / 3.0 : 0.5); }
  double outside(dvec2 p) const {
    return shape.triangle ? std::max({-p.x, -p.y, p.x + p.y - 1.0})
                          : std::max({-p.x, p.x - 1.0, -p.y, p.y - 1.0});
  }
  RayPoint<T> magnitude() const {
    RayPoint<T> most;
    for (const RayPoint<T>& p : c) most = abs_max(most, p);
    return most;
  }
  T largest_coefficient() const {
    const RayPoint<T> m = magnitude();
    return std::max(std::max(m.f, m.g), std::max(m.h, m.w));
  }

  void halve(int edge, CertifiedPiece& low, CertifiedPiece& high) const {
    low = high = *this;
    shape.for_lines(edge, [&](const int* places, int count) {
      RayPoint<T> line[max_degree + 1];
      for (int k = 0; k < count; ++k) line[k] = c[static_cast<std::size_t>(places[k])];
      for (int level = 0; level < count; ++level) {
        low.c[static_cast<std::size_t>(places[level])] = line[0];
        high.c[static_cast<std::size_t>(places[count - 1 - level])] = line[count - 1 - level];
        for (int k = 0; k + level + 1 < count; ++k) line[k] = T(0.5) * (line[k] + line[k + 1]);
      }
    });
    low.error = high.error = error + 2 * shape.degree(edge) * roundoff<T> * largest_coefficient();
    const dvec2 corner[3] = {origin + along_a, origin + along_b, origin};
    if (!shape.triangle) {
      dvec2 CertifiedPiece::*along = edge == 0 ? &CertifiedPiece::along_a : &CertifiedPiece::along_b;
      low.*along *= 0.5, high.*along *= 0.5;
      high.origin += high.*along;
      return;
    }
    const int from = edge, to = (edge + 1) % 3;
    const dvec2 half = 0.5 * (corner[from] + corner[to]);
    const auto place = [](CertifiedPiece& piece, const dvec2* at) {
      piece.origin = at[2], piece.along_a = at[0] - at[2], piece.along_b = at[1] - at[2];
    };
    dvec2 moved[3] = {corner[0], corner[1], corner[2]};
    moved[to] = half;
    place(low, moved);
    moved[to] = corner[to], moved[from] = half;
    place(high, moved);
  }

  // Difference of neighbouring coefficients along a parameter, times the degree: the derivative's
  // coefficients, to visit(coefficient). Their error is below 2 degree (error + roundoff |coefficients|).
  template <class Visit>
  void for_derivative(int parameter, const Visit& visit) const {
    const int degree = shape.degree(parameter);
    if (degree == 0) return visit(RayPoint<T>{});
    const T factor = degree;
    const int last_i = shape.triangle || parameter == 0 ? shape.m - 1 : shape.m;
    for (int i = 0; i <= last_i; ++i) {
      const int last_j = shape.triangle ? shape.n - 1 - i : parameter == 1 ? shape.n - 1 : shape.n;
      for (int j = 0; j <= last_j; ++j) {
        const int up = parameter == 0 ? shape.at(i + 1, j) : shape.at(i, j + 1);
        visit(factor * (c[static_cast<std::size_t>(up)] - c[static_cast<std::size_t>(shape.at(i, j))]));
      }
    }
  }
  T derivative_error() const {
    return 4 * std::max(shape.m, shape.n) * (error + roundoff<T> * largest_coefficient());
  }

  // Value by de Casteljau's algorithm, at a place inside: three roundings a level, degree(0) + degree(1)
  // levels at most.
  RayPoint<T> value(dvec2 p) const {
    static thread_local std::vector<RayPoint<T>> levels;  // kept so that nothing is allocated
    levels = c;
    RayPoint<T>* const work = levels.data();
    const T a = p.x, b = p.y;
    if (shape.triangle) {
      const T rest = 1 - a - b;
      for (int n = shape.n; n > 0; --n)
        for (int i = 0, to = 0; i < n; ++i)
          for (int j = 0; j < n - i; ++j, ++to)
            work[to] = a * work[triangle_index(n, i + 1, j)] + b * work[triangle_index(n, i, j + 1)] +
                       rest * work[triangle_index(n, i, j)];
      return work[0];
    }
    for (int i = 0; i <= shape.m; ++i) {
      RayPoint<T>* row = work + i * (shape.n + 1);
      for (int n = shape.n; n > 0; --n)
        for (int j = 0; j < n; ++j) row[j] = (1 - b) * row[j] + b * row[j + 1];
    }
    for (int m = shape.m; m > 0; --m)
      for (int i = 0; i < m; ++i)
        work[i * (shape.n + 1)] = (1 - a) * work[i * (shape.n + 1)] + a * work[(i + 1) * (shape.n + 1)];
    return work[0];
  }
  T value_error() const { return error + 8 * (shape.m + shape.n) * roundoff<T> * largest_coefficient(); }
};

// The whole patch.
template <class T>
CertifiedPiece<T> certified_piece(const Net& net, const CertifiedRay<T>& ray) {
  CertifiedPiece<T> out;
  out.shape = shape_of(net);
  out.c.reserve(points_of(net).size());
  for (const dvec4& p : points_of(net)) {
    out.c.push_back(ray(p));
    out.error = std::max(out.error, ray.error(p));
  }
  // Not so far that the powers themselves leave the numbers.
  const auto exponent = [](T size) { return size > 0 ? std::clamp(std::ilogb(size), -1000, 1000) : 0; };
  const RayPoint<T> most = out.magnitude();
  out.units = {exponent(std::max({most.f, most.g, most.h})), exponent(most.w)};
  const T position = std::ldexp(T(1), -out.units.position), weight = std::ldexp(T(1), -out.units.weight);
  for (RayPoint<T>& p : out.c) p = {position * p.f, position * p.g, position * p.h, weight * p.w};
  // And a few of the least number, where what is rounded underflows.
  constexpr T least = std::numeric_limits<T>::denorm_min();
  out.error = position * (out.error + 16 * least) + least;
  return out;
}

}  // namespace rondure
