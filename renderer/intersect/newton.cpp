#include "renderer/intersect/newton.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/dispatch.h"
#include "renderer/intersect/projected_net.h"

namespace rondure {
namespace {

constexpr double contraction_limit = 0.3;  // below the 1/3 at which Newton's error can stop shrinking
constexpr int step_limit = 16;             // of the patch; 2 or 3 are usual

struct Inverse {
  double aa, ab, ba, bb;  // rows of the inverse of (da db)
  Inverse(dvec2 da, dvec2 db) {
    const double r = 1.0 / (da.x * db.y - da.y * db.x);
    aa = db.y * r, ab = -db.x * r, ba = -da.y * r, bb = da.x * r;
  }
  dvec2 operator*(dvec2 f) const { return dvec2(aa * f.x + ab * f.y, ba * f.x + bb * f.y); }
  // Row sums of |inverse| . diag(f).
  dvec2 bound(dvec2 f) const {
    return dvec2(std::fabs(aa) * f.x + std::fabs(ab) * f.y, std::fabs(ba) * f.x + std::fabs(bb) * f.y);
  }
};

template <class Shape, class Evaluate>
NewtonVerdict search(const Leaf& leaf, const Evaluate& evaluate, const LocalRay& ray, double error,
                     Root& root, NewtonCounts& counts) {
  const dvec2 f = project(ray, leaf.center), da = project(ray, leaf.da), db = project(ray, leaf.db);
  const LocalRay& r = ray;
  const dvec4 p0 = glm::abs(r.plane[0]), p1 = glm::abs(r.plane[1]);
  const dvec4 spread = leaf.spread_a + leaf.spread_b;
  const Inverse inverse(da, db);
  // The Jacobian itself is rounded too: flat leaves have no spread, and yet no proof when a ray lies in them.
  const dvec2 slack = inverse.bound(dvec2(glm::dot(p0, spread), glm::dot(p1, spread)) + 4.0 * error);
  const dvec2 rounding = inverse.bound(dvec2(2.0 * error));
  const dvec2 room = slack * Shape::half_width() + rounding;
  dvec2 p = Shape::center() - inverse * f;
  // Written so that a singular Jacobian, whose inverse is not finite, is never taken for a proof.
  bool misses;
  if constexpr (std::is_same_v<Shape, TensorShape>)
    misses = std::fabs(p.x - 0.5) > 0.5 + room.x || std::fabs(p.y - 0.5) > 0.5 + room.y;
  else
    misses = p.x < -room.x || p.y < -room.y || p.x + p.y > 1.0 + room.x + room.y;
  const bool finite = std::isfinite(room.x + room.y);
  if (misses && finite) return NewtonVerdict::none;
  if (!finite || !(std::max(slack.x, slack.y) < contraction_limit)) return NewtonVerdict::undecided;

  ++counts.iterated;
  for (int k = 0; k < step_limit; ++k) {
    const dvec2 uv = leaf.to_patch(p);
    const FirstOrder<dvec4> s = evaluate(uv);
    ++counts.steps;
    const dvec2 fu = project(ray, s.du), fv = project(ray, s.dv);
    const Inverse local(leaf.edge_a.x * fu + leaf.edge_a.y * fv, leaf.edge_b.x * fu + leaf.edge_b.y * fv);
    const dvec2 step = local * project(ray, s.value);
    p -= step;
    // The contraction holds every iterate within the slack of a root of this leaf.
    if (!(Shape::outside(p) < contraction_limit)) return NewtonVerdict::none;
    // The next error is below (contraction limit) times the square of this one: beyond 1e-8 it is rounding.
    if (std::max(std::fabs(step.x), std::fabs(step.y)) < 1e-8) {
      const dvec2 at = leaf.to_patch(p);
      if (Shape::outside(p) > 0.0) {
        // Beside the leaf: of the neighbouring leaf, unless rounding put it here.
        const dvec2 tolerance = 2.0 * local.bound(dvec2(error)) + 4.0 * unit_roundoff;
        if (Shape::outside(p) > std::max(tolerance.x, tolerance.y)) return NewtonVerdict::none;
      }
      root = {at.x, at.y, false};
      return NewtonVerdict::root;
    }
  }
  return NewtonVerdict::undecided;
}

NewtonVerdict search_net(const Leaf& leaf, const TensorNet& net, const LocalRay& ray, double error,
                         Root& root, NewtonCounts& counts) {
  return with_degrees(net.m, net.n, [&](auto m, auto n) {
    const auto evaluate = [&](dvec2 p) {
      return tensor_first<m, n>(net.points.data(), net.m, net.n, p.x, p.y);
    };
    return search<TensorShape>(leaf, evaluate, ray, error, root, counts);
  });
}

NewtonVerdict search_net(const Leaf& leaf, const TriangleNet& net, const LocalRay& ray, double error,
                         Root& root, NewtonCounts& counts) {
  return with_degree(net.n, [&](auto n) {
    const auto evaluate = [&](dvec2 p) { return triangle_first<n>(net.points.data(), net.n, p.x, p.y); };
    return search<TriangleShape>(leaf, evaluate, ray, error, root, counts);
  });
}

}  // namespace

NewtonVerdict newton_on_leaf(const Leaf& leaf, const Net& net, const LocalRay& ray, double error, Root& root,
                             NewtonCounts& counts) noexcept {
  ++counts.leaves;
  const NewtonVerdict verdict =
      std::visit([&](const auto& n) { return search_net(leaf, n, ray, error, root, counts); }, net);
  if (verdict == NewtonVerdict::undecided) ++counts.undecided;
  return verdict;
}

}  // namespace rondure
