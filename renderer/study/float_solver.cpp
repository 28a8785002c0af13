#include "renderer/study/float_solver.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/bezier/quotient.h"
#include "renderer/bezier/tensor.h"
#include "renderer/bezier/triangle.h"
#include "renderer/sampling/warps.h"

namespace rondure {
namespace {

constexpr int cuts = 8;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float rounding = 0x1p-24f;

Vector3In<float> narrowed(const dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
float dot_in(const Vector3In<float>& a, const Vector3In<float>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// A ray as the meet of two planes.
struct FloatRay {
  Vector3In<float> origin, direction, plane[2];
};

struct Step {
  TangentsIn<float> at;
  float off[2], du, dv;  // distances from the planes, and the step that Newton's method takes
};

Step step_at(const Net& net, const FloatRay& ray, float u, float v) {
  Step step;
  step.at = tangents_in<float>(net, u, v);
  const auto& p = step.at.point;
  const Vector3In<float> away = {p[0] - ray.origin[0], p[1] - ray.origin[1], p[2] - ray.origin[2]};
  float f[2], fu[2], fv[2];
  for (int k = 0; k < 2; ++k) {
    step.off[k] = dot_in(ray.plane[k], away);
    f[k] = step.off[k] * step.at.weight;
    fu[k] = dot_in(ray.plane[k], step.at.du);
    fv[k] = dot_in(ray.plane[k], step.at.dv);
  }
  const float det = fu[0] * fv[1] - fu[1] * fv[0];
  step.du = (fv[1] * f[0] - fv[0] * f[1]) / det;
  step.dv = (fu[0] * f[1] - fu[1] * f[0]) / det;
  return step;
}

bool meets(const FloatRay& ray, const Vector3In<float>& low, const Vector3In<float>& high) {
  float enter = 0.0f, leave = infinity;
  for (std::size_t c = 0; c < 3; ++c) {
    const float inverse = quotient(1.0f, ray.direction[c]);
    float a = (low[c] - ray.origin[c]) * inverse, b = (high[c] - ray.origin[c]) * inverse;
    if (a > b) std::swap(a, b);
    enter = std::max(enter, a), leave = std::min(leave, b);
  }
  return enter <= leave;
}

bool on_patch(const Net& net, float u, float v) {
  if (!(u >= 0.0f && v >= 0.0f)) return false;
  return std::holds_alternative<TensorNet>(net) ? u <= 1.0f && v <= 1.0f : u + v <= 1.0f;
}

}  // namespace

FloatSolver::FloatSolver(const Net& world) : net_(world) {
  for (dvec4& p : points_of(net_)) {
    for (int c = 0; c < 4; ++c) p[c] = static_cast<float>(p[c]);
    for (int c = 0; c < 3; ++c) size_ = std::max(size_, static_cast<float>(std::abs(p[c] / p.w)));
  }
  std::vector<dvec4> piece(points_of(net_).size());
  for (int i = 0; i < cuts; ++i) {
    for (int j = 0; j < cuts; ++j) {
      const double step = 1.0 / cuts, u = i * step, v = j * step;
      if (const auto* tensor = std::get_if<TensorNet>(&net_)) {
        tensor_restrict(tensor->points.data(), tensor->m, tensor->n, u, u + step, v, v + step, piece.data());
        add_leaf(piece, {u + 0.5 * step, v + 0.5 * step});
        continue;
      }
      // The lower and the upper half of a square, as far as they are on the patch.
      const dvec2 halves[2][3] = {{{u, v}, {u + step, v}, {u, v + step}},
                                  {{u + step, v + step}, {u, v + step}, {u + step, v}}};
      const auto& triangle = std::get<TriangleNet>(net_);
      for (int half = 0; half < std::min(2, cuts - i - j); ++half) {
        const auto& c = halves[half];
        triangle_restrict(triangle.points.data(), triangle.n, c, piece.data());
        add_leaf(piece, (c[0] + c[1] + c[2]) / 3.0);
      }
    }
  }
}

void FloatSolver::add_leaf(const std::vector<dvec4>& points, dvec2 middle) {
  Leaf leaf{{infinity, infinity, infinity},
            {-infinity, -infinity, -infinity},
            static_cast<float>(middle.x),
            static_cast<float>(middle.y)};
  for (const dvec4& p : points) {
    for (int c = 0; c < 3; ++c) {
      const auto x = static_cast<float>(p[c] / p.w);
      float &low = leaf.low[static_cast<std::size_t>(c)], &high = leaf.high[static_cast<std::size_t>(c)];
      low = std::min(low, std::nextafter(x, -infinity));
      high = std::max(high, std::nextafter(x, infinity));
    }
  }
  leaves_.push_back(leaf);
}

std::optional<FloatHit> FloatSolver::closest(const Ray& given) const {
  const Frame frame = frame_about(glm::normalize(given.direction));
  const FloatRay ray{
      narrowed(given.origin), narrowed(given.direction), {narrowed(frame.x), narrowed(frame.y)}};
  float size = size_;
  for (const float x : ray.origin) size = std::max(size, std::abs(x));
  std::optional<FloatHit> best;
  for (const Leaf& leaf : leaves_) {
    if (!meets(ray, leaf.low, leaf.high)) continue;
    float u = leaf.u, v = leaf.v, last = infinity;
    for (int k = 0; k <= 8; ++k) {
      const Step step = step_at(net_, ray, u, v);
      const float off = std::max(std::abs(step.off[0]), std::abs(step.off[1]));
      if (off <= 16.0f * rounding * size && (k == 8 || off >= 0.5f * last)) {
        const auto& p = step.at.point;
        const float t =
            dot_in(ray.direction, {p[0] - ray.origin[0], p[1] - ray.origin[1], p[2] - ray.origin[2]}) /
            dot_in(ray.direction, ray.direction);
        if (on_patch(net_, u, v) && t > 0.0f && (!best || t < best->t)) best = FloatHit{u, v, t, step.at};
        break;
      }
      last = off;
      u -= step.du, v -= step.dv;
      if (!std::isfinite(u) || !std::isfinite(v)) break;
    }
  }
  return best;
}

}  // namespace rondure
