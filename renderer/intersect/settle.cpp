#include "renderer/intersect/settle.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/cell.h"
#include "renderer/intersect/projected_net.h"

namespace rondure {
namespace {

constexpr double reach = 0.25;  // further outside than this, rounding is not the reason

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
      sum[k] += factor * (static_cast<Extended>(plane.x) * point.x + static_cast<Extended>(plane.y) * point.y +
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
      for (int j = 0; j <= n - i; ++j) add(static_cast<Extended>(binomial(n, i)) * pu * bv[j], triangle.at(i, j));
    }
  }
  return dvec2(static_cast<double>(sum[0]), static_cast<double>(sum[1]));
}

double size_of(dvec2 f) { return std::fmax(std::fabs(f.x), std::fabs(f.y)); }

FirstOrder<dvec2> projected(const Net& net, const LocalRay& ray, dvec2 p) {
  const FirstOrder<dvec4> s = net_first(net, p.x, p.y);
  return {project(ray, s.value), project(ray, s.du), project(ray, s.dv)};
}

// Damped least-squares steps (Levenberg 1944), each kept only when it lowers the residual. The damping starts at nothing,
// for roots that are merely close, and grows until a step helps: near a singular point the patch hardly moves along one
// direction, and an undamped step would run away along it.
template <class Shape>
dvec2 improve(const Net& net, const LocalRay& ray, dvec2 p) {
  p = Shape::clamp(p);
  dvec2 f = extended_residual(net, ray, p);
  for (int k = 0; k < 12; ++k) {
    const FirstOrder<dvec2> s = projected(net, ray, p);
    const double aa = glm::dot(s.du, s.du), ab = glm::dot(s.du, s.dv), bb = glm::dot(s.dv, s.dv);
    const dvec2 right(glm::dot(s.du, f), glm::dot(s.dv, f));
    bool better = false;
    for (double damping = 1e-28 * (aa + bb); !better && damping < aa + bb; damping *= 1e4) {
      const double det = (aa + damping) * (bb + damping) - ab * ab;
      const dvec2 step = dvec2((bb + damping) * right.x - ab * right.y, (aa + damping) * right.y - ab * right.x) / det;
      if (!(size_of(step) < 1.0)) continue;
      const dvec2 q = Shape::clamp(p - step), next = extended_residual(net, ray, q);
      better = glm::dot(next, next) < glm::dot(f, f);
      if (better) p = q, f = next;
    }
    if (!better) break;
  }
  return p;
}

template <class Shape>
bool settle_in(const Net& net, double bound, const LocalRay& ray, Root& root) {
  dvec2 p(root.u, root.v);
  if (root.tangent) p = improve<Shape>(net, ray, p);
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
  } else if (!root.tangent) {
    return true;
  }
  root.u = p.x, root.v = p.y;
  // And the parameters are doubles: half an ulp of each moves the point by this much.
  const FirstOrder<dvec2> s = projected(net, ray, p);
  return size_of(extended_residual(net, ray, p)) <= bound + unit_roundoff * (size_of(s.du) + size_of(s.dv));
}

}  // namespace

bool settle(const Net& net, const NetScale& scale, const LocalRay& ray, Root& root) noexcept {
  const double bound = settled_bound(scale, ray);
  if (std::holds_alternative<TensorNet>(net)) return settle_in<TensorShape>(net, bound, ray, root);
  return settle_in<TriangleShape>(net, bound, ray, root);
}

}  // namespace rondure
