// Control nets: the only form in which a surface reaches the renderer.
//
// A control point is homogeneous, (w x, w y, w z, w), w last. Parameters run over [0, 1]^2 on a
// tensor-product patch and over u, v >= 0, u + v <= 1 on a triangular one, where (u, v, 1 - u - v) are
// barycentric. The normal d/du x d/dv points outward on closed surfaces.
#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <variant>
#include <vector>

namespace rondure {

using glm::dmat3;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

// Tensor-product net of degree (m, n): points[i * (n + 1) + j], i along u, j along v.
struct TensorNet {
  int m = 0;
  int n = 0;
  std::vector<dvec4> points;

  TensorNet() = default;
  TensorNet(int degree_u, int degree_v)
      : m(degree_u),
        n(degree_v),
        points(static_cast<std::size_t>(degree_u + 1) * static_cast<std::size_t>(degree_v + 1), dvec4(0.0)) {}

  dvec4& at(int i, int j) { return points[static_cast<std::size_t>(i * (n + 1) + j)]; }
  const dvec4& at(int i, int j) const { return points[static_cast<std::size_t>(i * (n + 1) + j)]; }
};

// Place of the coefficient of u^i v^j w^(n-i-j) in a triangular net of degree n: i outermost, then j.
constexpr int triangle_index(int n, int i, int j) { return i * (n + 1) - i * (i - 1) / 2 + j; }
constexpr int triangle_size(int n) { return (n + 1) * (n + 2) / 2; }

// Triangular net of degree n, ordered by triangle_index.
struct TriangleNet {
  int n = 0;
  std::vector<dvec4> points;

  TriangleNet() = default;
  explicit TriangleNet(int degree)
      : n(degree), points(static_cast<std::size_t>(triangle_size(degree)), dvec4(0.0)) {}

  dvec4& at(int i, int j) { return points[static_cast<std::size_t>(triangle_index(n, i, j))]; }
  const dvec4& at(int i, int j) const { return points[static_cast<std::size_t>(triangle_index(n, i, j))]; }
};

using Net = std::variant<TensorNet, TriangleNet>;

inline const std::vector<dvec4>& points_of(const Net& net) {
  return std::visit([](const auto& n) -> const std::vector<dvec4>& { return n.points; }, net);
}
inline std::vector<dvec4>& points_of(Net& net) {
  return std::visit([](auto& n) -> std::vector<dvec4>& { return n.points; }, net);
}

// Whether both nets are of one kind and of the same degrees.
inline bool same_degrees(const Net& a, const Net& b) {
  if (a.index() != b.index()) return false;
  if (const auto* t = std::get_if<TensorNet>(&a))
    return t->m == std::get<TensorNet>(b).m && t->n == std::get<TensorNet>(b).n;
  return std::get<TriangleNet>(a).n == std::get<TriangleNet>(b).n;
}

}  // namespace rondure
