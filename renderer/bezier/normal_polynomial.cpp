#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/normal.h"
#include "renderer/bezier/wedge.h"

namespace rondure {
namespace {

double largest_coordinate(const std::vector<dvec4>& points) {
  dvec3 largest(0.0);
  for (const dvec4& p : points) largest = glm::max(largest, glm::abs(dvec3(p)));
  return std::max({largest.x, largest.y, largest.z});
}

// The exponent e for which 2^-e x is in [1, 2); 0 where there is none.
int exponent_of(double x) { return x > 0.0 && std::isfinite(x) ? std::ilogb(x) : 0; }

void scale_by_exponents(std::vector<dvec4>& points, int space, int weight) {
  for (dvec4& p : points) {
    for (int c = 0; c < 3; ++c) p[c] = std::ldexp(p[c], -space);
    p.w = std::ldexp(p.w, -weight);
  }
}

// The mean of the points, rounded to a quarter of the net's extent at most: of few bits, so that moving a net
// by it rounds little, and zero for one about the origin. Zero too where the weights cancel.
dvec3 coarse_centre(const std::vector<dvec4>& points) {
  dvec4 sum(0.0);
  double weights = 0.0;
  for (const dvec4& p : points) {
    sum += p;
    weights += std::abs(p.w);
  }
  if (!(std::abs(sum.w) > 0x1p-10 * weights)) return dvec3(0.0);
  const dvec3 mean = dvec3(sum) / sum.w;
  double extent = 0.0;
  for (const dvec4& p : points) extent = std::max(extent, glm::length(dvec3(p) - p.w * mean));
  if (!(extent > 0.0)) return mean;
  const double grid = std::ldexp(1.0, exponent_of(extent) - 1);
  return glm::round(mean / grid) * grid;
}

// A net in a frame of its own: N has the same directions there, but no unit of length and no distance from
// the origin are left that its rounding errors could be mistaken for.
struct Framed {
  Net net;           // the largest coordinate and the largest weight are in [1, 2)
  double error;      // of a coordinate, from the rounding of the given net: epsilon, more for one far away
  int exponent = 0;  // the given net has 2^exponent times the N of this one
};

Framed framed(const Net& given) {
  Framed f{given, epsilon, 0};
  std::vector<dvec4>& points = points_of(f.net);
  double weight = 0.0;
  for (const dvec4& p : points) weight = std::max(weight, std::abs(p.w));
  const int weight_exponent = exponent_of(weight);
  const int given_exponent = exponent_of(largest_coordinate(points));
  scale_by_exponents(points, given_exponent, weight_exponent);
  const dvec3 centre = coarse_centre(points);
  const double far = largest_coordinate(points);
  for (dvec4& p : points) p -= dvec4(p.w * centre, 0.0);
  const double near = largest_coordinate(points);
  const int near_exponent = exponent_of(near);
  scale_by_exponents(points, near_exponent, 0);
  if (near > 0.0) f.error = epsilon * std::max(1.0, far / near);
  // Every term of N has one weight and two coordinates.
  f.exponent = weight_exponent + 2 * (given_exponent + near_exponent);
  return f;
}

// A coefficient sums products of three control points; its rounding error stays below some tens of times that
// of those products, whose sizes `terms` sums. What is smaller carries no direction.
template <class Normals, class Terms>
void flush_noise(Normals& normals, const Terms& terms, double error) {
  for (std::size_t k = 0; k < normals.coefficients.size(); ++k) {
    if (!(glm::length(normals.coefficients[k]) > 64.0 * error * terms.coefficients[k]))
      normals.coefficients[k] = {};
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

TrianglePolynomial<dvec4> corner_net(const TriangleNet& net, int a, int b) {
  TrianglePolynomial<dvec4> sub(net.n - 1);
  for (int i = 0; i < net.n; ++i) {
    for (int j = 0; j < net.n - i; ++j) sub.at(i, j) = net.at(i + a, j + b);
  }
  return sub;
}

// The sizes of a sub-net's points, of which wedge products are no larger than the products.
TensorPolynomial<double> sizes(const TensorPolynomial<dvec4>& net) {
  TensorPolynomial<double> out(net.m, net.n);
  for (std::size_t k = 0; k < net.coefficients.size(); ++k)
    out.coefficients[k] = glm::length(net.coefficients[k]);
  return out;
}

TrianglePolynomial<double> sizes(const TrianglePolynomial<dvec4>& net) {
  TrianglePolynomial<double> out(net.n);
  for (std::size_t k = 0; k < net.coefficients.size(); ++k)
    out.coefficients[k] = glm::length(net.coefficients[k]);
  return out;
}

// m n [(1-u)(1-v) T(00,10,01) + u(1-v) T(00,10,11) + (1-u)v T(00,11,01) + uv T(10,11,01)], T the product of
// three sub-nets F_ab by `line` and `plane`.
template <class Result, class Net, class LineOf, class PlaneOf>
TensorPolynomial<Result> sum_at_corners(int m, int n, const Net (&f)[2][2], LineOf line, PlaneOf plane) {
  const auto l1101 = multiply(f[1][1], f[0][1], line);
  const TensorPolynomial<Result> at_corner[2][2] = {
      {multiply(f[0][0], multiply(f[1][0], f[0][1], line), plane), multiply(f[0][0], l1101, plane)},
      {multiply(f[0][0], multiply(f[1][0], f[1][1], line), plane), multiply(f[1][0], l1101, plane)}};
  TensorPolynomial<Result> sum(3 * m - 2, 3 * n - 2);
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      TensorPolynomial<double> weight(1, 1);
      weight.at(a, b) = static_cast<double>(m * n);
      sum = add_scaled(std::move(sum), multiply(weight, at_corner[a][b]), 1.0);
    }
  }
  return sum;
}

TensorPolynomial<dvec3> tensor_normals(const TensorNet& net, double error) {
  if (net.m < 1 || net.n < 1) return {};
  const TensorPolynomial<dvec4> f[2][2] = {{corner_net(net, 0, 0), corner_net(net, 0, 1)},
                                           {corner_net(net, 1, 0), corner_net(net, 1, 1)}};
  const TensorPolynomial<double> s[2][2] = {{sizes(f[0][0]), sizes(f[0][1])},
                                            {sizes(f[1][0]), sizes(f[1][1])}};
  TensorPolynomial<dvec3> normals = sum_at_corners<dvec3>(net.m, net.n, f, join, join_plane);
  flush_noise(normals, sum_at_corners<double>(net.m, net.n, s, std::multiplies<>{}, std::multiplies<>{}),
              error);
  return normals;
}

TrianglePolynomial<dvec3> triangle_normals(const TriangleNet& net, double error) {
  if (net.n < 1) return {};
  const TrianglePolynomial<dvec4> f10 = corner_net(net, 1, 0), f01 = corner_net(net, 0, 1),
                                  f00 = corner_net(net, 0, 0);
  TrianglePolynomial<dvec3> normals = multiply(f10, multiply(f01, f00, join), join_plane);
  flush_noise(normals, multiply(sizes(f10), multiply(sizes(f01), sizes(f00))), error);
  const double square = static_cast<double>(net.n * net.n);
  for (dvec3& n : normals.coefficients) n *= square;
  return normals;
}

NormalPolynomial normals_of(const Framed& f) {
  if (const auto* t = std::get_if<TensorNet>(&f.net)) return tensor_normals(*t, f.error);
  return triangle_normals(std::get<TriangleNet>(f.net), f.error);
}

}  // namespace

NormalPolynomial normal_directions(const Net& net) { return normals_of(framed(net)); }

NormalPolynomial normal_polynomial(const Net& net) {
  const Framed f = framed(net);
  NormalPolynomial normals = normals_of(f);
  std::visit(
      [&](auto& p) {
        for (dvec3& n : p.coefficients) {
          for (int c = 0; c < 3; ++c) n[c] = std::ldexp(n[c], f.exponent);
        }
      },
      normals);
  return normals;
}

}  // namespace rondure
