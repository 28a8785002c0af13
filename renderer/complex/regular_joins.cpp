#include "renderer/complex/regular_joins.h"

#include <cmath>

namespace rondure {
namespace {

constexpr double two_pi = 6.28318530717958647693;

std::size_t index(int k) { return static_cast<std::size_t>(k); }

// 2 cos(2 pi / N).
Exact spoke_sum(const VertexFan& fan, bool& exact) {
  const std::size_t n = fan.closed ? fan.corners.size() : 4;
  if (n == 1) return 2;
  if (n == 2) return -2;
  if (n == 3) return -1;
  if (n == 4) return 0;
  if (n == 6) return 1;
  exact = false;
  return Exact(2.0 * std::cos(two_pi / static_cast<double>(n)));
}

}  // namespace

SurfaceComplex regular_complex(const std::vector<int>& sides, const std::vector<Gluing>& gluings) {
  SurfaceComplex complex;
  complex.sides = sides;
  for (const Gluing& g : gluings) {
    complex.joins.push_back({g.p, g.q, edge_parameter(g.reversed), {}});
  }
  const std::vector<VertexFan> fans = vertex_fans(complex);
  const auto fan_at = fan_of_corner(complex, fans);
  for (std::size_t k = 0; k < gluings.size(); ++k) {
    const Gluing& g = gluings[k];
    const int sides_p = sides[index(g.p.polygon)], sides_q = sides[index(g.q.polygon)];
    const auto sum_at = [&](int corner) {
      const int fan = fan_at[index(g.p.polygon)][index(corner % sides_p)];
      return spoke_sum(fans[index(fan)], complex.exact);
    };
    const Exact start = sum_at(g.p.edge), end = sum_at(g.p.edge + 1);
    // With `inward` as the second spoke at the edge's start: inward_p + inward_q = start along. At its end
    // the spoke is `inward` on a square and inward - along on a triangle, seen from there `along` points
    // away: the sum of the spokes is -end along.
    const int triangles = (sides_p == 3 ? 1 : 0) + (sides_q == 3 ? 1 : 0);
    const EdgePolynomial blend = linear(start, Exact(triangles) - end - start);
    EdgeField image{EdgeFunction(blend), EdgeFunction(-1)};
    // Both frames are those of corner 0 of p's edge so far. Over there along turns round where the parameter
    // does, and the frame's inward starts from the other corner.
    if (g.reversed) {
      const EdgePolynomial shift = sides_q == 3 ? 1 : 0;
      image.along = EdgeFunction(EdgePolynomial(-1) * blend + shift);
    }
    complex.joins[k] = join_by_image(g.p, g.q, edge_parameter(g.reversed), image);
  }
  return complex;
}

}  // namespace rondure
