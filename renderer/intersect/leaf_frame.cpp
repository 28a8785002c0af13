#include "renderer/intersect/leaf_frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/intersect/interval.h"

namespace rondure {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();

// Of what is not below zero; what is no number or infinite stays so.
float up(double x) {
  const float rounded = static_cast<float>(x) + 0.0f;  // and zero has no sign
  return rounded < unbounded ? std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) + 1) : rounded;
}

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

// The largest |d - center|, componentwise, of the derivatives d = degree (difference) / enlargement: rounded
// as each of them is, and in their order.
dvec4 spread(int degree, const dvec4& low, const dvec4& high, const dvec4& center) {
  const auto off = [&](const dvec4& difference) {
    return glm::abs(static_cast<double>(degree) * difference / leaf_enlargement - center);
  };
  return glm::max(off(low), off(high));
}

int degree_a(const TensorShape& shape) { return shape.m; }
int degree_b(const TensorShape& shape) { return shape.n; }
int degree_a(const TriangleShape& shape) { return shape.n; }
int degree_b(const TriangleShape& shape) { return shape.n; }

void leave_unbounded(LeafFrame& f) {
  f = {};
  f.bound[0] = f.bound[1] = f.bound_zeta = f.bound_weight = unbounded;
  f.slack = f.slack_weight = f.slack_zeta[0] = f.slack_zeta[1] = f.bound_bend = unbounded;
}

}  // namespace

template <class Shape>
Evenness set_frame(const Shape& shape, const LeafArithmetic<Shape>& arithmetic,
                   const LeafParameters& parameters, const SecondOrder<dvec4>& center, const dvec4* points,
                   const dvec4* wide, Leaf& leaf) {
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

  const FrameExtent extent =
      arithmetic.extent(shape, {frame, 1.0 / center.value.w, parameters, points, wide});
  const dvec4& most = extent.off;
  const Interval zeta{std::min(0.0, extent.zeta_low), std::max(0.0, extent.zeta_high)};
  const dvec3 bend(frame.bend[0], frame.bend[1], frame.bend[2]);
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
    // w^2 (zeta - bend (xi^2, ..)) = N_zeta w - bend (N_xi^2, ..), which is
    // (N_zeta - bend (a^2, ..)) + N_zeta (w - 1) - bend (N_xi^2 - a^2, ..), each of the third order.
    const double half = Shape::half_width(), x = most.x, y = most.y;
    const dvec3 squares(x * (2.0 * half + x), half * (x + y) + x * y, y * (2.0 * half + y));
    const double higher =
        extent.sagging + std::max(zeta.high, -zeta.low) * most.w + glm::dot(glm::abs(bend), squares);
    frame.bound_bend = up(1.0001 * (higher / ((1.0 - most.w) * (1.0 - most.w)) + error * rows[2]));
  }

  const dvec4 by_a = spread(degree_a(shape), extent.a_low, extent.a_high, dvec4(1.0, 0.0, 0.0, 0.0));
  const dvec4 by_b = spread(degree_b(shape), extent.b_low, extent.b_high, dvec4(0.0, 1.0, 0.0, 0.0));
  const dvec4 slack = by_a + by_b;
  // The Jacobian is rounded too: a flat leaf has no slack, and yet no proof when a ray lies in it.
  frame.slack = up(std::max(slack.x, slack.y) + 4.0 * error * std::max(rows[0], rows[1]));
  frame.slack_zeta[0] = up(by_a.z + 2.0 * error * rows[2]);
  frame.slack_zeta[1] = up(by_b.z + 2.0 * error * rows[2]);
  frame.slack_weight = up(slack.w);

  const double straight = frame.slack + Shape::half_width() * frame.slack_weight;
  return {straight, straight + size * std::max(rows[0] * frame.slack_zeta[0], rows[1] * frame.slack_zeta[1])};
}

template Evenness set_frame(const TensorShape&, const LeafArithmetic<TensorShape>&, const LeafParameters&,
                            const SecondOrder<dvec4>&, const dvec4*, const dvec4*, Leaf&);
template Evenness set_frame(const TriangleShape&, const LeafArithmetic<TriangleShape>&, const LeafParameters&,
                            const SecondOrder<dvec4>&, const dvec4*, const dvec4*, Leaf&);

}  // namespace rondure
