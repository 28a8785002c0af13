#include "renderer/complex/regular_joins.h"

#include <cmath>

#include "renderer/bezier/index.h"

namespace rondure {
namespace {

constexpr double two_pi = 6.28318530717958647693;

// 2 cos(2 pi / N). On the boundary nothing has to close: corners of 90 degrees, or where that would be too
// many of them, of a little less than a half-turn's share each, 2 cos(pi / n) < 2 - 9 / n^2.
Exact spoke_sum(const VertexFan& fan, bool& exact) {
  const int corners = static_cast<int>(fan.corners.size());
  if (!fan.closed && corners > 3) return 2 - Exact(9) / (corners * corners);
  const std::size_t n = fan.closed ? fan.corners.size() : 4;
  if (n == 1) return 2;
  if (n == 2) return -2;
  if (n == 3) return -1;
  if (n == 4) return 0;
  if (n == 6) return 1;
  exact = false;
  return exact_of(2.0 * std::cos(two_pi / static_cast<double>(n)));
}

// 2 cos(2 pi / N) along an edge, in terms of the frame at the first edge's start: values and slopes at the
// ends.
struct Blend {
  Exact value[2], slope[2];
};

EdgePolynomial hermite(const Blend& b) {
  const Exact rise = b.value[1] - b.value[0];
  std::vector<Exact> c(4);
  c[0] = b.value[0], c[1] = b.slope[0];
  c[2] = 3 * rise - 2 * b.slope[0] - b.slope[1];
  c[3] = b.slope[0] + b.slope[1] - 2 * rise;
  return EdgePolynomial(std::move(c));
}

// Which end of its join's first edge a step of a fan passes by.
std::size_t end_at(const SurfaceComplex& complex, const VertexFan& fan, std::size_t step) {
  const FanStep& s = fan.steps[step];
  const Corner& on_p = fan.corners[s.forwards ? step : (step + 1) % fan.corners.size()];
  return on_p.corner == complex.joins[index(s.join)].p.edge ? 0 : 1;
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
  std::vector<Blend> blends;
  for (const Gluing& g : gluings) {
    const int sides_p = sides[index(g.p.polygon)], sides_q = sides[index(g.q.polygon)];
    const auto sum_at = [&](int corner) {
      const int fan = fan_at[index(g.p.polygon)][index(corner % sides_p)];
      return spoke_sum(fans[index(fan)], complex.exact);
    };
    // With `inward` as the second spoke at the edge's start: inward_p + inward_q = start along. At its end
    // the spoke is `inward` on a square and inward - along on a triangle, seen from there `along` points
    // away: the sum of the spokes is -end along.
    const int triangles = (sides_p == 3 ? 1 : 0) + (sides_q == 3 ? 1 : 0);
    const Exact start = sum_at(g.p.edge), end = triangles - sum_at(g.p.edge + 1);
    blends.push_back({{start, end}, {end - start, end - start}});
  }
  // Where four corners meet, the mixed second derivatives of functions ask for the same slope on opposite
  // edges: with others, functions would not change along one of them.
  const std::vector<Blend> straight = blends;
  for (const VertexFan& fan : fans) {
    if (!fan.closed || fan.corners.size() != 4) continue;
    for (std::size_t step = 0; step < 4; ++step) {
      const std::size_t here = index(fan.steps[step].join), opposite = index(fan.steps[(step + 2) % 4].join);
      blends[here].slope[end_at(complex, fan, step)] =
          (straight[here].slope[0] + straight[opposite].slope[0]) / 2;
    }
  }
  for (std::size_t k = 0; k < gluings.size(); ++k) {
    const Gluing& g = gluings[k];
    const EdgePolynomial blend = hermite(blends[k]);
    EdgeField image{EdgeFunction(blend), EdgeFunction(-1)};
    // Both frames are those of corner 0 of p's edge so far. Over there along turns round where the parameter
    // does, and the frame's inward starts from the other corner.
    if (g.reversed) {
      const EdgePolynomial shift = sides[index(g.q.polygon)] == 3 ? 1 : 0;
      image.along = EdgeFunction(EdgePolynomial(-1) * blend + shift);
    }
    complex.joins[k] = join_by_image(g.p, g.q, edge_parameter(g.reversed), image);
  }
  return complex;
}

}  // namespace rondure
