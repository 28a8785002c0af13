// Pieces of a patch's parameter domain, and the Bernstein operations that the searches need on them.
//
// A shape knows the degree; a cell is a place in the patch's domain with its own local parameters (a, b): [0,
// 1]^2 on a rectangle, barycentric (a, b, 1 - a - b) on a triangle. Searches are written once, over either
// shape.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "renderer/bezier/dispatch.h"
#include "renderer/bezier/tensor.h"
#include "renderer/bezier/triangle.h"

namespace rondure {

struct RectangleCell {
  dvec2 low{0.0};
  dvec2 high{1.0};
};

struct TriangleCell {
  dvec2 corner[3] = {{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}};  // where a = 1, b = 1, and both are 0
};

struct TensorShape {
  using Cell = RectangleCell;
  int m, n;

  int size() const { return (m + 1) * (n + 1); }
  bool can_derive_a() const { return m > 0; }
  bool can_derive_b() const { return n > 0; }
  TensorShape derived_a() const { return {m - 1, n}; }
  TensorShape derived_b() const { return {m, n - 1}; }
  static dvec2 center() { return dvec2(0.5); }
  static double half_width() { return 0.5; }

  template <class T>
  void derive_a(const T* f, T* out) const {
    tensor_derivative_u(f, m, n, out);
  }
  template <class T>
  void derive_b(const T* f, T* out) const {
    tensor_derivative_v(f, m, n, out);
  }
  template <class T>
  FirstOrder<T> first(const T* f, dvec2 p) const {
    return with_degrees(m, n, [&](auto a, auto b) { return tensor_first<a, b>(f, m, n, p.x, p.y); });
  }
  template <class T>
  SecondOrder<T> second(const T* f, dvec2 p) const {
    return with_degrees(m, n, [&](auto a, auto b) { return tensor_second_by_sums<a, b>(f, m, n, p.x, p.y); });
  }
  template <class T>
  void restrict_to(const T* patch, const Cell& c, T* out) const {
    tensor_restrict(patch, m, n, c.low.x, c.high.x, c.low.y, c.high.y, out);
  }

  // Which parameter (0: a, 1: b) moves the polynomials more; `da` and `db` are scratch of the net's size.
  int steepest_edge(const dvec2* f, dvec2*, dvec2*) const {
    double along_a = 0.0, along_b = 0.0;
    for (int i = 0; i <= m; ++i)
      for (int j = 0; j <= n; ++j) {
        const dvec2 p = f[i * (n + 1) + j], d = glm::abs(p - f[j]), e = glm::abs(p - f[i * (n + 1)]);
        along_a = std::max({along_a, d.x, d.y});
        along_b = std::max({along_b, e.x, e.y});
      }
    return along_a >= along_b ? 0 : 1;
  }

  // Halves the cell across a (edge 0) or b (edge 1).
  static void halve(const Cell& c, int edge, Cell& low, Cell& high) {
    low = high = c;
    low.high[edge] = high.low[edge] = 0.5 * (c.low[edge] + c.high[edge]);
  }

  // The same; `low` and `high` receive the two nets.
  template <class T>
  void halve(const T* f, const Cell& c, int edge, T* low, T* high, Cell& low_cell, Cell& high_cell) const {
    halve(c, edge, low_cell, high_cell);
    if (edge == 0)
      tensor_halve_u(f, m, n, low, high);
    else
      tensor_halve_v(f, m, n, low, high);
  }

  // How far (a, b) lies outside the cell; at most 0 inside.
  static double outside(dvec2 p) { return std::max({-p.x, p.x - 1.0, -p.y, p.y - 1.0}); }
  static dvec2 to_patch(const Cell& c, dvec2 p) { return c.low + p * (c.high - c.low); }
  // The nearest point of the domain, and along which direction one may move there: 0 at a corner.
  static dvec2 clamp(dvec2 p) { return dvec2(std::clamp(p.x, 0.0, 1.0), std::clamp(p.y, 0.0, 1.0)); }
  static dvec2 boundary_direction(dvec2 p) {
    const bool x = p.x < 0.0 || p.x > 1.0, y = p.y < 0.0 || p.y > 1.0;
    return dvec2(x ? 0.0 : 1.0, y ? 0.0 : 1.0) * (x && y ? 0.0 : 1.0);
  }
};

struct TriangleShape {
  using Cell = TriangleCell;
  int n;

  int size() const { return triangle_size(n); }
  bool can_derive_a() const { return n > 0; }
  bool can_derive_b() const { return n > 0; }
  TriangleShape derived_a() const { return {n - 1}; }
  TriangleShape derived_b() const { return {n - 1}; }
  static dvec2 center() { return dvec2(1.0 / 3.0); }
  // Largest |a - center| over the cell.
  static double half_width() { return 2.0 / 3.0; }

  template <class T>
  void derive_a(const T* f, T* out) const {
    triangle_derivative_u(f, n, out);
  }
  template <class T>
  void derive_b(const T* f, T* out) const {
    triangle_derivative_v(f, n, out);
  }
  template <class T>
  FirstOrder<T> first(const T* f, dvec2 p) const {
    return with_degree(n, [&](auto a) { return triangle_first<a>(f, n, p.x, p.y); });
  }
  template <class T>
  SecondOrder<T> second(const T* f, dvec2 p) const {
    return with_degree(n, [&](auto a) { return triangle_second<a>(f, n, p.x, p.y); });
  }
  template <class T>
  void restrict_to(const T* patch, const Cell& c, T* out) const {
    triangle_restrict(patch, n, c.corner, out);
  }

  // Edges: 0 from the corner a = 1 to b = 1, 1 on to a = b = 0, 2 back.
  static int longest_edge(const Cell& c) {
    int longest = 0;
    double length2 = -1.0;
    for (int k = 0; k < 3; ++k) {
      const dvec2 e = c.corner[(k + 1) % 3] - c.corner[k];
      if (const double l = e.x * e.x + e.y * e.y; l > length2) length2 = l, longest = k;
    }
    return longest;
  }

  // The edge along which the polynomials change most, from their derivatives.
  int steepest_edge(const dvec2* f, dvec2* da, dvec2* db) const {
    derive_a(f, da);
    derive_b(f, db);
    double change[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < derived_a().size(); ++k) {
      const dvec2 along[3] = {glm::abs(db[k] - da[k]), glm::abs(db[k]), glm::abs(da[k])};
      for (int j = 0; j < 3; ++j) change[j] = std::max({change[j], along[j].x, along[j].y});
    }
    return static_cast<int>(std::max_element(change, change + 3) - change);
  }

  static void halve(const Cell& c, int edge, Cell& low, Cell& high) {
    const int next = (edge + 1) % 3;
    low = high = c;
    low.corner[next] = high.corner[edge] = 0.5 * (c.corner[edge] + c.corner[next]);
  }

  template <class T>
  void halve(const T* f, const Cell& c, int edge, T* low, T* high, Cell& low_cell, Cell& high_cell) const {
    static constexpr dvec2 local[3] = {{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}};
    const int next = (edge + 1) % 3;
    dvec2 low_corner[3] = {local[0], local[1], local[2]}, high_corner[3] = {local[0], local[1], local[2]};
    low_corner[next] = high_corner[edge] = 0.5 * (local[edge] + local[next]);
    halve(c, edge, low_cell, high_cell);
    triangle_restrict(f, n, low_corner, low);
    triangle_restrict(f, n, high_corner, high);
  }

  static double outside(dvec2 p) { return std::max({-p.x, -p.y, p.x + p.y - 1.0}); }
  static dvec2 to_patch(const Cell& c, dvec2 p) {
    return c.corner[2] + p.x * (c.corner[0] - c.corner[2]) + p.y * (c.corner[1] - c.corner[2]);
  }
  static dvec2 clamp(dvec2 p) {
    p = dvec2(std::max(p.x, 0.0), std::max(p.y, 0.0));
    const double sum = p.x + p.y;
    if (sum <= 1.0) return p;
    const double x = std::min(p.x / sum, 1.0);
    return dvec2(x, 1.0 - x);  // their sum is 1 to the last bit
  }
  static dvec2 boundary_direction(dvec2 p) {
    const bool x = p.x < 0.0, y = p.y<0.0, z = p.x + p.y> 1.0;
    if (x + y + z > 1) return dvec2(0.0);
    return x ? dvec2(0.0, 1.0) : y ? dvec2(1.0, 0.0) : dvec2(1.0, -1.0);
  }
};

}  // namespace rondure
