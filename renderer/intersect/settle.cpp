#include "renderer/intersect/settle.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/quotient.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/cell.h"
#include "renderer/intersect/newton_step.h"
#include "renderer/intersect/projected_net.h"
#include "renderer/intersect/strong_direction.h"

namespace rondure {
namespace {

constexpr double reach = 0.25;  // further outside than this, rounding is not the reason
constexpr double longest_sharpening = 0x1p-26;

using Extended = long double;

// out[k] = C(n, k) t^k s^(n - k)
void extended_basis(int n, Extended t, Extended s, Extended* out) {
  Extended power = 1;
  for (int k = 0; k <= n; ++k) out[k] = static_cast<Extended>(binomial(n, k)) * power, power *= t;
  power = 1;
  for (int k = n; k >= 0; --k) out[k] *= power, power *= s;
}

// (plane0 . S, plane1 . S), rounded once at the end.
dvec2 extended_residual(const Net& net, const LocalRay& ray, dvec2 p) {
  Extended sum[2] = {0, 0};
  const auto add = [&](Extended factor, const dvec4& point) {
    for (int k = 0; k < 2; ++k) {
      const dvec4& plane = ray.plane[k];
      sum[k] +=
          factor * (static_cast<Extended>(plane.x) * point.x + static_cast<Extended>(plane.y) * point.y +
                    static_cast<Extended>(plane.z) * point.z + static_cast<Extended>(plane.w) * point.w);
    }
  };
  const Extended u = p.x, v = p.y;
  Extended bu[max_degree + 1], bv[max_degree + 1];
  if (const auto* tensor = std::get_if<TensorNet>(&net)) {
    extended_basis(tensor->m, u, 1 - u, bu);
    extended_basis(tensor->n, v, 1 - v, bv);
    for (int i = 0; i <= tensor->m; ++i)
      for (int j = 0; j <= tensor->n; ++j) add(bu[i] * bv[j], tensor->at(i, j));
  } else {
    const auto& triangle = std::get<TriangleNet>(net);
    const int n = triangle.n;
    Extended pu = 1;
    for (int i = 0; i <= n; ++i, pu *= u) {
      extended_basis(n - i, v, 1 - u - v, bv);
      for (int j = 0; j <= n - i; ++j)
        add(static_cast<Extended>(binomial(n, i)) * pu * bv[j], triangle.at(i, j));
    }
  }
  return dvec2(static_cast<double>(sum[0]), static_cast<double>(sum[1]));
}

double size_of(dvec2 f) { return std::fmax(std::fabs(f.x), std::fabs(f.y)); }

FirstOrder<dvec2> projected(const Net& net, const LocalRay& ray, dvec2 p) {
  const FirstOrder<dvec4> s = net_first(net, p.x, p.y);
  return {project(ray, s.value), project(ray, s.du), project(ray, s.dv)};
}

// One step of Newton's method for the strong equation alone, within the domain. What a side takes of it, the
// parameter along that side makes up for: a step that is only cut off closes in on the side's best point as
// slowly as the two slopes are unlike, and is left beside it. Not where the side is collapsed.
template <class Shape>
dvec2 correct_strong(const Net& net, const LocalRay& ray, dvec2 p) {
  const FirstOrder<dvec2> at = projected(net, ray, p);
  const dvec2 strong = strong_direction(at.du, at.dv),
              slope(glm::dot(strong, at.du), glm::dot(strong, at.dv));
  const double steepness = glm::dot(slope, slope);
  if (!(steepness > 0.0)) return p;
  const dvec2 full = p - slope * (glm::dot(strong, extended_residual(net, ray, p)) / steepness);
  p = Shape::clamp(full);
  if (!(Shape::outside(full) > 0.0)) return p;
  const dvec2 along = Shape::boundary_direction(full);
  const double step = quotient(glm::dot(strong, extended_residual(net, ray, p)), glm::dot(slope, along));
  return std::fabs(step) < reach ? Shape::clamp(p - step * along) : p;
}

// Newton's method where the Jacobian is nearly singular. A full step follows the direction in which the patch
// hardly moves, and curvature throws it off the other equation; so each trial step, shortened until it helps,
// is followed by a correction of the strong equation alone. Kept only when the residual falls; done when it
// is a quarter of `bound`. Where a ray runs in the plane of a side and meets it twice, a long step leaves the
// one root for the other: so the correction alone is taken if it will do, and within `bound` steps are short.
template <class Shape>
dvec2 improve(const Net& net, double bound, const LocalRay& ray, dvec2 p) {
  constexpr double longest = 0.5, longest_within = 0x1p-13;
  const double enough = 0.25 * bound;
  p = Shape::clamp(p);
  dvec2 f = extended_residual(net, ray, p);
  const auto take_if = [&](const auto& good, dvec2 q) {
    const dvec2 next = extended_residual(net, ray, q);
    if (!good(next)) return false;
    p = q, f = next;
    return true;
  };
  const auto is_better = [&](dvec2 next) { return glm::dot(next, next) < glm::dot(f, f); };
  const auto will_do = [&](dvec2 next) { return size_of(next) <= bound; };
  if (!will_do(f)) take_if(will_do, correct_strong<Shape>(net, ray, p));
  for (int k = 0; k < 16 && size_of(f) > enough; ++k) {
    const FirstOrder<dvec2> s = projected(net, ray, p);
    const double det = s.du.x * s.dv.y - s.du.y * s.dv.x;
    const dvec2 full =
        det != 0.0 ? dvec2(s.dv.y * f.x - s.dv.x * f.y, s.du.x * f.y - s.du.y * f.x) / det : dvec2(0.0);
    const double length = size_of(full), most = will_do(f) ? longest_within : longest;
    bool better = false;
    // The last trial is the correction alone.
    for (double part = std::fmin(1.0, quotient(most, length)); !better; part *= 0.25) {
      if (!(part * length > unit_roundoff)) part = 0.0;  // lost in the parameters
      const dvec2 from = part == 0.0 ? p : Shape::clamp(p - part * full);
      better = take_if(is_better, correct_strong<Shape>(net, ray, from));
      if (part == 0.0) break;
    }
    if (!better) break;
  }
  return p;
}

// A step of Newton's method by what the residual really is: that of doubles leaves a root off by its rounding
// over the cosine, and so perhaps outside where it is inside. Where rounding is not the reason, the place
// stays.
dvec2 sharpened(const Net& net, const LocalRay& ray, dvec2 p) {
  const FirstOrder<dvec2> s = projected(net, ray, p);
  const dvec2 step = newton_step(extended_residual(net, ray, p), s.du, s.dv);
  const bool is_short = std::fabs(step.x) < longest_sharpening && std::fabs(step.y) < longest_sharpening;
  return is_short ? p - step : p;
}

template <class Shape>
bool settle_in(const Net& net, double bound, const LocalRay& ray, Root& root) {
  dvec2 p(root.u, root.v);
  if (root.tangent)
    p = improve<Shape>(net, bound, ray, p);
  else if (Shape::outside(p) > 0.0)
    p = sharpened(net, ray, p);
  else
    return true;
  if (const double beyond = Shape::outside(p); beyond > 0.0) {
    if (!(beyond < reach)) return false;
    const dvec2 along = Shape::boundary_direction(p);
    p = Shape::clamp(p);
    for (int k = 0; k < 5; ++k) {
      const FirstOrder<dvec2> s = projected(net, ray, p);
      const dvec2 slope = along.x * s.du + along.y * s.dv;
      const double steepness = glm::dot(slope, slope);
      if (!(steepness > 0.0)) break;
      const double step = -glm::dot(extended_residual(net, ray, p), slope) / steepness;
      const dvec2 next = Shape::clamp(p + std::fmin(std::fmax(step, -reach), reach) * along);
      if (next == p) break;
      p = next;
      if (std::fabs(step) < 1e-15) break;
    }
  }
  root.u = p.x, root.v = p.y;
  // And the parameters are doubles: half an ulp of each moves the point by this much.
  const FirstOrder<dvec2> s = projected(net, ray, p);
  return size_of(extended_residual(net, ray, p)) <= bound + unit_roundoff * (size_of(s.du) + size_of(s.dv));
}

}  // namespace

bool settle(const Net& net, const NetScale& scale, const LocalRay& ray, Root& root) noexcept {
  const double bound = settled_bound(scale, ray);
  const bool settled = std::holds_alternative<TensorNet>(net)
                           ? settle_in<TensorShape>(net, bound, ray, root)
                           : settle_in<TriangleShape>(net, bound, ray, root);
  // Beside a control point of next to no weight the point's own may underflow: it then has no place in space.
  return settled && net_first(net, root.u, root.v).value.w > 0.0;
}

}  // namespace rondure
