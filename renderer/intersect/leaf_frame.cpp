#include "renderer/intersect/leaf_frame.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/intersect/interval.h"

namespace rondure {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();

float up(double x) { return std::nextafter(static_cast<float>(x), unbounded); }

// The surface in space at the leaf's centre, by the leaf's parameters.
struct CenterJet {
  dvec3 x, a, b, aa, ab, bb;
};

CenterJet jet_of(const SecondOrder<dvec4>& s, const Leaf& leaf) {
  const double w = s.value.w;
  const dvec3 x = dvec3(s.value) / w;
  const dvec3 u = (dvec3(s.du) - s.du.w * x) / w, v = (dvec3(s.dv) - s.dv.w * x) / w;
  const dvec3 uu = (dvec3(s.duu) - 2.0 * s.du.w * u - s.duu.w * x) / w,
              uv = (dvec3(s.duv) - s.du.w * v - s.dv.w * u - s.duv.w * x) / w,
              vv = (dvec3(s.dvv) - 2.0 * s.dv.w * v - s.dvv.w * x) / w;
  const dvec2 &e = leaf.edge_a, &f = leaf.edge_b;
  const auto second = [&](dvec2 p, dvec2 q) {
    return p.x * q.x * uu + (p.x * q.y + p.y * q.x) * uv + p.y * q.y * vv;
  };
  return {x, e.x * u + e.y * v, f.x * u + f.y * v, second(e, e), second(e, f), second(f, f)};
}

// The largest |f - center|, componentwise, of the coefficients of a derivative.
dvec4 spread(std::span<const dvec4> f, const dvec4& center) {
  dvec4 most(0.0);
  for (const dvec4& p : f) most = glm::max(most, glm::abs(p - center));
  return most;
}

// The leaf's parameters less those of its centre, at the net's points: the Bernstein coefficients of (a, b).
template <class Visit>
void visit_parameters(const TensorShape& shape, const Visit& visit) {
  std::size_t k = 0;
  for (int i = 0; i <= shape.m; ++i)
    for (int j = 0; j <= shape.n; ++j)
      visit(k++, i, j, dvec2(static_cast<double>(i) / shape.m, static_cast<double>(j) / shape.n) - 0.5);
}
template <class Visit>
void visit_parameters(const TriangleShape& shape, const Visit& visit) {
  std::size_t k = 0;
  for (int i = 0; i <= shape.n; ++i)
    for (int j = 0; j <= shape.n - i; ++j)
      visit(k++, i, j, dvec2(static_cast<double>(i) / shape.n, static_cast<double>(j) / shape.n) - 1.0 / 3.0);
}

// The Bernstein coefficients of (a^2, a b, b^2), for a shape of degree 2 at least.
dvec3 square_coefficients(const TensorShape& shape, int i, int j, dvec2 p) {
  const auto square = [](int n, int k, double a) {  // (t - 1/2)^2 less its value at the coefficient's place
    const double t = static_cast<double>(k) / n;
    return a * a - t * (1.0 - t) / (n - 1);
  };
  return {square(shape.m, i, p.x), p.x * p.y, square(shape.n, j, p.y)};
}
dvec3 square_coefficients(const TriangleShape& shape, int i, int j, dvec2 p) {
  const double n = shape.n, u = i / n, v = j / n, rest = 1.0 / (n - 1.0);
  return {p.x * p.x - u * (1.0 - u) * rest, p.x * p.y + u * v * rest, p.y * p.y - v * (1.0 - v) * rest};
}
bool has_squares(const TensorShape& shape) { return shape.m > 1 && shape.n > 1; }
bool has_squares(const TriangleShape& shape) { return shape.n > 1; }

void leave_unbounded(LeafFrame& f) {
  f = {};
  f.bound[0] = f.bound[1] = f.bound_zeta = f.bound_weight = unbounded;
  f.slack = f.slack_weight = f.slack_zeta[0] = f.slack_zeta[1] = f.bound_bend = unbounded;
}

// Homogeneous coordinates to those of the frame, the weight of the centre being 1.
struct ToFrame {
  const LeafFrame& frame;
  double weight;  // 1 over that of the centre

  dvec4 operator()(const dvec4& p) const {
    const dvec2 across =
        p.x * frame.across[0] + p.y * frame.across[1] + p.z * frame.across[2] + p.w * frame.across[3];
    return weight * dvec4(across, glm::dot(frame.normal, p), p.w);
  }
};

template <class Shape>
Evenness set(const Shape& shape, const SecondOrder<dvec4>& center, std::span<const dvec4> points,
             std::span<dvec4> wide, Leaf& leaf) {
  LeafFrame& frame = leaf.frame;
  leave_unbounded(frame);
  const CenterJet s = jet_of(center, leaf);
  const double length_a = glm::length(s.a), length_b = glm::length(s.b), size = std::max(length_a, length_b);
  const dvec3 across = glm::cross(s.a, s.b);
  const double area = glm::length(across);
  if (!(area > 1e-9 * length_a * length_b) || !(length_a > 0.0) || !shape.can_derive_a() ||
      !shape.can_derive_b())
    return {};

  // The basis dual to (S_a, S_b, size n).
  const dvec3 n = across / area, da = glm::cross(s.b, n) / area, db = glm::cross(n, s.a) / area,
              dn = n / size;
  for (int k = 0; k < 3; ++k) frame.across[k] = dvec2(da[k], db[k]);
  frame.across[3] = -dvec2(glm::dot(da, s.x), glm::dot(db, s.x));
  frame.normal = dvec4(dn, -glm::dot(dn, s.x));

  const auto put = [&](int k, const dvec3& second, float factor) {
    frame.bend[k] = factor * static_cast<float>(glm::dot(dn, second));
    frame.turn[k][0] = factor * static_cast<float>(glm::dot(da, second));
    frame.turn[k][1] = factor * static_cast<float>(glm::dot(db, second));
  };
  put(0, s.aa, 0.5f), put(1, s.ab, 1.0f), put(2, s.bb, 0.5f);

  const ToFrame to_frame{frame, 1.0 / center.value.w};
  dvec4 most(0.0);
  Interval zeta;
  const dvec3 bend(frame.bend[0], frame.bend[1], frame.bend[2]);
  double sagging = has_squares(shape) ? 0.0 : unbounded;
  visit_parameters(shape, [&](std::size_t k, int i, int j, dvec2 p) {
    const dvec4 here = to_frame(points[k]);
    most = glm::max(most, glm::abs(here - dvec4(p, 0.0, 1.0)));
    zeta = {std::min(zeta.low, here.z), std::max(zeta.high, here.z)};
    if (has_squares(shape))
      sagging = std::max(sagging, std::fabs(here.z - glm::dot(bend, square_coefficients(shape, i, j, p))));
  });
  // Rounding of a ray's plane may move a root by so much, and the frame's own by less. A ray that meets the
  // leaf is no further from the origin than the leaf.
  const double reach = largest(s.x) + 2.0 * size, error = 8.0 * residual_roundoffs * unit_roundoff *
                                                          (reach + leaf.scale.position / center.value.w);
  const double rows[3] = {glm::length(da), glm::length(db), glm::length(dn)};
  frame.bound[0] = up(most.x + error * rows[0]);
  frame.bound[1] = up(most.y + error * rows[1]);
  frame.middle_zeta = static_cast<float>(0.5 * (zeta.low + zeta.high));
  frame.bound_zeta =
      up(std::max(zeta.high - frame.middle_zeta, frame.middle_zeta - zeta.low) + error * rows[2]);
  frame.bound_weight = up(most.w);
  frame.bound_bend = unbounded;
  // Where rounding of the frame is nothing beside the leaf.
  if (most.w < 0.5 && error * std::max({rows[0], rows[1], rows[2]}) < 1e-10) {
    // w^2 (zeta - bend (xi^2, ..)) = N_zeta w - bend (N_xi^2, ..) = (N_zeta - bend (a^2, ..)) + N_zeta (w -
    // 1)
    // - bend (N_xi^2 - a^2, ..), each of the third order.
    const double half = Shape::half_width(), x = most.x, y = most.y;
    const dvec3 squares(x * (2.0 * half + x), half * (x + y) + x * y, y * (2.0 * half + y));
    const double higher =
        sagging + std::max(zeta.high, -zeta.low) * most.w + glm::dot(glm::abs(bend), squares);
    frame.bound_bend = up(1.0001 * (higher / ((1.0 - most.w) * (1.0 - most.w)) + error * rows[2]));
  }

  for (dvec4& p : wide) p = to_frame(p);
  dvec4 derivative[max_net_size];
  const auto derived = [&](const Shape& of) {
    for (int k = 0; k < of.size(); ++k) derivative[k] /= leaf_enlargement;
    return std::span<const dvec4>(derivative, static_cast<std::size_t>(of.size()));
  };
  shape.derive_a(wide.data(), derivative);
  const dvec4 by_a = spread(derived(shape.derived_a()), dvec4(1.0, 0.0, 0.0, 0.0));
  shape.derive_b(wide.data(), derivative);
  const dvec4 by_b = spread(derived(shape.derived_b()), dvec4(0.0, 1.0, 0.0, 0.0));
  const dvec4 slack = by_a + by_b;
  // The Jacobian is rounded too: a flat leaf has no slack, and yet no proof when a ray lies in it.
  frame.slack = up(std::max(slack.x, slack.y) + 4.0 * error * std::max(rows[0], rows[1]));
  frame.slack_zeta[0] = up(by_a.z + 2.0 * error * rows[2]);
  frame.slack_zeta[1] = up(by_b.z + 2.0 * error * rows[2]);
  frame.slack_weight = up(slack.w);

  const double straight = frame.slack + Shape::half_width() * frame.slack_weight;
  return {straight, straight + size * std::max(rows[0] * frame.slack_zeta[0], rows[1] * frame.slack_zeta[1])};
}

}  // namespace

Evenness set_frame(const TensorShape& shape, const SecondOrder<dvec4>& center, std::span<const dvec4> points,
                   std::span<dvec4> wide, Leaf& leaf) {
  return set(shape, center, points, wide, leaf);
}

Evenness set_frame(const TriangleShape& shape, const SecondOrder<dvec4>& center,
                   std::span<const dvec4> points, std::span<dvec4> wide, Leaf& leaf) {
  return set(shape, center, points, wide, leaf);
}

}  // namespace rondure
