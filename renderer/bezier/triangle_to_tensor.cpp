#include "renderer/bezier/triangle_to_tensor.h"

#include "renderer/bezier/compose.h"

namespace rondure {
namespace {

// More digits than a double has: the powers in a composition are sums of products, and thirds are rounded.
using Real = long double;
using Point = std::array<Real, 2>;

TensorNet part(const TriangleNet& net, const std::array<Point, 4>& corners) {
  PlanarMap<TensorPolynomial<Real>> map{{1, 1}, {1, 1}, {1, 1}};
  for (int s = 0; s < 2; ++s) {
    for (int t = 0; t < 2; ++t) {
      const Point& p = corners[static_cast<std::size_t>(s + 2 * t)];
      map.x.at(s, t) = p[0], map.y.at(s, t) = p[1], map.w.at(s, t) = 1;
    }
  }
  return compose(net, map);
}

}  // namespace

TensorNet tensor_part(const TriangleNet& net, const std::array<dvec2, 4>& corners) {
  std::array<Point, 4> exact;
  for (std::size_t k = 0; k < 4; ++k) exact[k] = {corners[k].x, corners[k].y};
  return part(net, exact);
}

TensorNet as_degenerate_tensor(const TriangleNet& net) {
  const Point u{1, 0}, v{0, 1}, w{0, 0};
  return part(net, {u, v, u, w});
}

std::array<TensorNet, 3> as_three_tensors(const TriangleNet& net) {
  const Real half = Real(1) / 2, third = Real(1) / 3;
  const Point u{1, 0}, v{0, 1}, w{0, 0}, uv{half, half}, vw{0, half}, uw{half, 0}, centre{third, third};
  return {part(net, {u, uv, uw, centre}), part(net, {v, vw, uv, centre}), part(net, {w, uw, vw, centre})};
}

}  // namespace rondure
