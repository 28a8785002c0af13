#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/bezier/normal.h"

namespace rondure {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// The line through two homogeneous points, as the wedge product needs it.
struct Line {
  dvec3 moment{0.0}, direction{0.0};

  Line() = default;
  explicit Line(double) {}
  Line(const dvec3& m, const dvec3& d) : moment(m), direction(d) {}
  Line& operator+=(const Line& o) {
    moment += o.moment;
    direction += o.direction;
    return *this;
  }
  Line& operator*=(double s) {
    moment *= s;
    direction *= s;
    return *this;
  }
  Line& operator/=(double s) {
    moment /= s;
    direction /= s;
    return *this;
  }
};

Line join(const dvec4& g, const dvec4& h) {
  return {glm::cross(dvec3(g), dvec3(h)), h.w * dvec3(g) - g.w * dvec3(h)};
}

// Normal part of the plane through a point and a line: F_w (G x H) + G_w (H x F) + H_w (F x G).
dvec3 join_plane(const dvec4& f, const Line& gh) {
  return f.w * gh.moment + glm::cross(dvec3(f), gh.direction);
}

double largest_norm(const std::vector<dvec4>& points) {
  double largest = 0.0;
  for (const dvec4& p : points) largest = std::max(largest, glm::length(p));
  return largest;
}

// A coefficient sums products of three control points; its rounding error stays below some tens of eps times
// their size. What is smaller carries no direction.
void flush_noise(std::vector<dvec3>& normals, double bound) {
  for (dvec3& n : normals) {
    if (!(glm::length(n) > bound)) n = dvec3(0.0);
  }
}

// Sub-net P_(i+a)(j+b) of degree (m - 1, n - 1). A direction of degree 0 has no derivative, hence no normal.
TensorPolynomial<dvec4> corner_net(const TensorNet& net, int a, int b) {
  TensorPolynomial<dvec4> sub(net.m - 1, net.n - 1);
  for (int i = 0; i < net.m; ++i) {
    for (int j = 0; j < net.n; ++j) sub.at(i, j) = net.at(i + a, j + b);
  }
  return sub;
}

// N = m n [(1-u)(1-v) T(00,10,01) + u(1-v) T(00,10,11) + (1-u)v T(00,11,01) + uv T(10,11,01)], T the wedge
// product of the sub-nets F_ab.
TensorPolynomial<dvec3> tensor_normals(const TensorNet& net) {
  if (net.m < 1 || net.n < 1) return {};
  const auto f00 = corner_net(net, 0, 0);
  const auto f10 = corner_net(net, 1, 0);
  const auto f01 = corner_net(net, 0, 1);
  const auto f11 = corner_net(net, 1, 1);
  const auto l1101 = multiply(f11, f01, join);
  const TensorPolynomial<dvec3> at_corner[2][2] = {
      {multiply(f00, multiply(f10, f01, join), join_plane), multiply(f00, l1101, join_plane)},
      {multiply(f00, multiply(f10, f11, join), join_plane), multiply(f10, l1101, join_plane)}};
  TensorPolynomial<dvec3> normals(3 * net.m - 2, 3 * net.n - 2);
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      TensorPolynomial<double> weight(1, 1);
      weight.at(a, b) = static_cast<double>(net.m * net.n);
      normals = add_scaled(std::move(normals), multiply(weight, at_corner[a][b]), 1.0);
    }
  }
  const double size = largest_norm(net.points);
  flush_noise(normals.coefficients, 64.0 * epsilon * net.m * net.n * size * size * size);
  return normals;
}

TrianglePolynomial<dvec4> corner_net(const TriangleNet& net, int a, int b) {
  TrianglePolynomial<dvec4> sub(net.n - 1);
  for (int i = 0; i < net.n; ++i) {
    for (int j = 0; j < net.n - i; ++j) sub.at(i, j) = net.at(i + a, j + b);
  }
  return sub;
}

TrianglePolynomial<dvec3> triangle_normals(const TriangleNet& net) {
  if (net.n < 1) return {};
  const auto lines = multiply(corner_net(net, 0, 1), corner_net(net, 0, 0), join);
  TrianglePolynomial<dvec3> normals = multiply(corner_net(net, 1, 0), lines, join_plane);
  const double square = static_cast<double>(net.n * net.n);
  for (dvec3& n : normals.coefficients) n *= square;
  const double size = largest_norm(net.points);
  flush_noise(normals.coefficients, 64.0 * epsilon * square * size * size * size);
  return normals;
}

}  // namespace

NormalPolynomial normal_polynomial(const Net& net) {
  if (const auto* t = std::get_if<TensorNet>(&net)) return tensor_normals(*t);
  return triangle_normals(std::get<TriangleNet>(net));
}

}  // namespace rondure
