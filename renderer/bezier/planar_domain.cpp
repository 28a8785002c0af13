#include "renderer/bezier/planar_domain.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/bezier/corners.h"
#include "renderer/bezier/rational.h"
#include "renderer/bezier/tensor.h"
#include "renderer/bezier/triangle.h"

namespace rondure {
namespace {

constexpr double slack = 0x1p-30;

// The least of what must not be negative inside the domain.
double inside_by(const dvec4& p, ParameterDomain domain) {
  if (domain == ParameterDomain::triangle) return std::min({p.x, p.y, p.w - p.x - p.y});
  return std::min({p.x, p.w - p.x, p.y, p.w - p.y});
}

bool clear(const std::vector<dvec4>& points, ParameterDomain domain) {
  return std::all_of(points.begin(), points.end(),
                     [&](const dvec4& p) { return p.w > 0.0 && inside_by(p, domain) >= -slack * p.w; });
}

std::optional<DomainFault> fault_at(const dvec4& p, ParameterDomain domain) {
  if (!(p.w > 0.0)) return DomainFault{true, dvec2(0.0)};
  if (inside_by(p, domain) < -slack * p.w) return DomainFault{false, dvec2(p) / p.w};
  return std::nullopt;
}

std::vector<TensorNet> quarters_of(const TensorNet& net) {
  std::vector<TensorNet> half(2, TensorNet(net.m, net.n)), out(4, TensorNet(net.m, net.n));
  tensor_halve_u(net.points.data(), net.m, net.n, half[0].points.data(), half[1].points.data());
  for (std::size_t k = 0; k < 2; ++k) {
    tensor_halve_v(half[k].points.data(), net.m, net.n, out[2 * k].points.data(),
                   out[2 * k + 1].points.data());
  }
  return out;
}

std::vector<TriangleNet> quarters_of(const TriangleNet& net) {
  std::vector<TriangleNet> out(4, TriangleNet(net.n));
  triangle_quarter(net.points.data(), net.n, out[0].points.data(), out[1].points.data(), out[2].points.data(),
                   out[3].points.data());
  return out;
}

template <class N>
std::optional<DomainFault> search(const N& net, ParameterDomain domain, int depth) {
  constexpr int deepest = 7;
  if (clear(net.points, domain)) return std::nullopt;
  for (const dvec4& corner : corners_of(net)) {
    if (const auto fault = fault_at(corner, domain)) return fault;
  }
  if (depth == deepest) {
    // A weight that may vanish between the corners is one too many; so near an edge of the domain all is
    // well.
    const bool positive =
        std::all_of(net.points.begin(), net.points.end(), [](const dvec4& p) { return p.w > 0.0; });
    return positive ? std::nullopt : std::optional(DomainFault{true, dvec2(0.0)});
  }
  for (const N& part : quarters_of(net)) {
    if (const auto fault = search(part, domain, depth + 1)) return fault;
  }
  return std::nullopt;
}

}  // namespace

std::optional<DomainFault> domain_fault(const Net& planar, ParameterDomain domain) {
  return std::visit([&](const auto& net) { return search(net, domain, 0); }, planar);
}

std::optional<PlanarFold> planar_fold(const Net& planar) {
  constexpr int steps = 16;
  constexpr double rounding = 1e-9;  // far above what the sums of a net of degree 24 lose
  const bool triangle = std::holds_alternative<TriangleNet>(planar);
  std::optional<dvec2> left, right;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= (triangle ? steps - i : steps); ++j) {
      const dvec2 at = dvec2(i, j) / double(steps);
      const FirstOrder<dvec4> f = net_first(planar, at.x, at.y);
      const auto row = [](const dvec4& p) { return dvec3(p.x, p.y, p.w); };
      const dvec3 p = row(f.value), du = row(f.du), dv = row(f.dv);
      const double jacobian = glm::dot(p, glm::cross(du, dv));
      if (!(std::fabs(jacobian) > rounding * glm::length(p) * glm::length(du) * glm::length(dv))) continue;
      (jacobian > 0.0 ? left : right) = at;
    }
  }
  if (!left || !right) return std::nullopt;
  return PlanarFold{*left, *right};
}

}  // namespace rondure
