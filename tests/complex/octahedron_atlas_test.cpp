// The charts of section 4, and Theorem 4.2: differentiable in the charts is geometrically continuous.
#include "renderer/complex/octahedron_atlas.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "renderer/complex/gc_function.h"
#include "renderer/complex/octahedron_bases.h"
#include "renderer/complex/shipped.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

using Kind = OctantChart::Kind;
using SurfaceFunction = std::function<double(const OctantPoint&)>;

std::vector<OctantChart> all_charts() {
  std::vector<OctantChart> charts;
  for (int octant = 0; octant < 8; ++octant) {
    charts.push_back({Kind::inside, octant, 0});
    for (int part = 0; part < 3; ++part) {
      charts.push_back({Kind::edge, octant, part});
      charts.push_back({Kind::corner, octant, part});
    }
  }
  return charts;
}

std::string named(const OctantChart& c, const dvec3& b) {
  return fmt::format("chart {} {} of octant {} at ({:.6g}, {:.6g}, {:.6g})", static_cast<int>(c.kind), c.part,
                     c.octant, b.x, b.y, b.z);
}

SurfaceFunction on_surface(const GcFunction& f) {
  return [f](const OctantPoint& p) { return value_at(f, p.octant, p.barycentric.x, p.barycentric.y); };
}

// Points of the chart with a coordinate 0: on the edges where it glues octants.
std::vector<dvec3> seam_points(const OctantChart& chart) {
  std::vector<dvec3> points;
  for (int zero = 0; zero < 3; ++zero) {
    for (int k = -40; k <= 40; ++k) {
      dvec3 b(0.0);
      b[(zero + 1) % 3] = k / 30.0;
      b[(zero + 2) % 3] = 1.0 - k / 30.0;
      if (in_chart(chart, b)) points.push_back(b);
    }
  }
  return points;
}

// How far the derivatives across a seam differ, by differences of second order from either side.
double jump(const SurfaceFunction& f, const OctantChart& chart, const dvec3& b, int zero) {
  const double h = 1e-5;
  const auto side = [&](double step) {
    const auto at = [&](double s) {
      dvec3 p = b;
      p[zero] += s;
      p[(zero + 1) % 3] -= 0.4 * s;
      p[(zero + 2) % 3] -= 0.6 * s;
      return f(chart_point(chart, p));
    };
    return (4.0 * at(step) - at(2.0 * step) - 3.0 * at(0.0)) / (2.0 * step);
  };
  return std::abs(side(h) - side(-h));
}

// The largest jump over all seams of all charts.
WorstCase largest_jump(const SurfaceFunction& f, double tolerance) {
  WorstCase worst;
  for (const OctantChart& chart : all_charts()) {
    for (const dvec3& b : seam_points(chart)) {
      for (int axis = 0; axis < 3; ++axis) {
        if (b[axis] == 0.0) worst.add(jump(f, chart, b, axis), tolerance, [&] { return named(chart, b); });
      }
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("chart maps reach the surface and come back", "[complex]") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1.0, 2.0);
  std::size_t inside[3] = {0, 0, 0}, outside = 0;
  double worst = 0.0;
  for (const OctantChart& chart : all_charts()) {
    for (int k = 0; k < 2000; ++k) {
      const double u = uniform(random), v = uniform(random);
      const dvec3 b(u, v, 1.0 - u - v);
      if (!in_chart(chart, b)) continue;
      ++inside[static_cast<int>(chart.kind)];
      const OctantPoint p = chart_point(chart, b);
      const dvec3& q = p.barycentric;
      if (!(q.x >= 0.0 && q.y >= 0.0 && q.z >= 0.0 && std::abs(q.x + q.y + q.z - 1.0) < 1e-14)) ++outside;
      worst = std::fmax(worst, glm::length(chart_coordinates(chart, p) - b));
    }
  }
  CHECK(outside == 0);
  // The sum of coordinates by which the map divides is at least 1/3 in the charts; points reach size 2.
  CHECK(worst < 1e-14);
  for (const std::size_t count : inside) CHECK(count > 500);
}

TEST_CASE("transition maps are the gluing on edges, involutions, and commute", "[complex]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  double worst = 0.0, derivative = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double u = 0.6 + 0.3 * uniform(random), v = 0.1 * uniform(random);
    const dvec3 b(u, v, 1.0 - u - v);
    const auto distance = [&](const dvec3& p, const dvec3& q) {
      worst = std::fmax(worst, glm::length(p - q));
    };
    distance(transition(1, 0, transition(0, 1, b)), b);
    // Octants 0, 1, 2, 3 meet at P: phi_14 = phi_24 phi_12 = phi_34 phi_13 in the paper's numbers.
    distance(transition(1, 3, transition(0, 1, b)), transition(0, 3, b));
    distance(transition(2, 3, transition(0, 2, b)), transition(0, 3, b));
    distance(transition(0, 1, {u, 1.0 - u, 0.0}), {u, 1.0 - u, 0.0});
    const glm::dmat2 d = transition_derivative(0, 2, b);
    const double h = 1e-6;
    for (int axis = 0; axis < 2; ++axis) {
      dvec3 step(0.0);
      step[axis] = h, step.z = -h;
      const dvec3 slope = (transition(0, 2, b + step) - transition(0, 2, b - step)) / (2.0 * h);
      derivative = std::fmax(derivative, glm::length(dvec2(slope) - d[axis]));
    }
  }
  // Sums of 0.2 at least: divisions lose a factor 5 twice.
  CHECK(worst < 1e-14);
  // Differences of a function with derivatives up to 10^3: h^2 1e3 / 6 and eps / h.
  CHECK(derivative < 1e-8);
}

TEST_CASE("equation 4.8: along an edge the derivative of a transition map is theta", "[complex]") {
  const SurfaceComplex h = octahedron_complex();
  double worst = 0.0;
  for (const EdgeJoin& join : h.joins) {
    const auto frame = edge_frame(3, join.p.edge);
    for (int k = 0; k <= 10; ++k) {
      const double s = k / 10.0;
      const auto corner = corner_point(3, join.p.edge);
      const dvec2 x(corner[0] + s * frame[0][0], corner[1] + s * frame[0][1]);
      const glm::dmat2 d = transition_derivative(join.p.polygon, join.q.polygon, {x.x, x.y, 1.0 - x.x - x.y});
      for (std::size_t column = 0; column < 2; ++column) {
        const dvec2 image = d * dvec2(frame[column][0], frame[column][1]);
        const double along = join.bundle[0][column].at(s), inward = join.bundle[1][column].at(s);
        const dvec2 theta(along * frame[0][0] + inward * frame[1][0],
                          along * frame[0][1] + inward * frame[1][1]);
        worst = std::fmax(worst, glm::length(image - theta));
      }
    }
  }
  CHECK(worst < 1e-15 * 16);
}

TEST_CASE("Theorem 4.2: geometrically continuous functions are differentiable in every chart", "[complex]") {
  // Second-order differences with step 1e-5 of polynomials and quotients whose third derivatives reach 10^5
  // and values 10 in the charts: 1e5 h^2 + 10 eps / h.
  const double tolerance = 3e-5;
  for (const GcBasis& basis : {octahedron_splines(3), octahedron_splines(4), octahedron_rationals()}) {
    WorstCase worst;
    for (std::size_t k = 0; k < basis.functions.size(); k += 3) {
      worst.merge(largest_jump(on_surface(function_of(basis, k)), tolerance));
    }
    INFO(worst.text());
    CHECK(worst.count() > 1000);
    CHECK(worst.failures() == 0);
  }
}

TEST_CASE("Theorem 4.2: what is continuous only has a jump in some chart", "[complex]") {
  const SurfaceComplex h = octahedron_complex();
  GcFunction f = function_of(octahedron_splines(3), 0);
  CHECK(is_gc1(h, f));
  // One coefficient beside the edge PQ of octant 0: nothing else touches it, continuity stays.
  f.numerators[0].coefficients[static_cast<std::size_t>(triangle_index(3, 1, 1))] += 1;
  const GcDefect defect = gc1_defect(h, f);
  CHECK(defect.value == 0.0);
  CHECK(defect.derivative > 1.0);
  const WorstCase worst = largest_jump(on_surface(f), 3e-5);
  CHECK(worst.failures() > 0);
  CHECK(worst.error() > 0.1);
}

TEST_CASE("Theorem 4.2: functions of the sphere, differentiable there, satisfy the conditions", "[complex]") {
  // The charts are central projections of octants to planes: any smooth function of the direction x / |x|.
  const auto smooth = [](const dvec3& x) {
    const dvec3 d = glm::normalize(x);
    return std::sin(2.0 * d.x + d.y) + d.y * d.z + std::exp(d.z * d.x);
  };
  const SurfaceComplex h = octahedron_complex();
  const auto at = [&](int octant, const dvec2& uv) {
    const dvec3 b(uv.x, uv.y, 1.0 - uv.x - uv.y);
    return smooth(dvec3(octant & 4 ? -b.x : b.x, octant & 2 ? -b.y : b.y, octant & 1 ? -b.z : b.z));
  };
  const auto slope = [&](int octant, const dvec2& x, const dvec2& along) {
    const double step = 1e-5;
    return (at(octant, x + step * along) - at(octant, x - step * along)) / (2.0 * step);
  };
  double worst = 0.0;
  for (const EdgeJoin& join : h.joins) {
    const auto frame = edge_frame(3, join.p.edge);
    const dvec2 along(frame[0][0], frame[0][1]), inward(frame[1][0], frame[1][1]);
    const auto corner = corner_point(3, join.p.edge);
    for (int k = 0; k <= 10; ++k) {
      const double s = k / 10.0;
      const dvec2 x = dvec2(corner[0], corner[1]) + s * along;
      const dvec2 image = join.bundle[0][1].at(s) * along + join.bundle[1][1].at(s) * inward;
      worst = std::fmax(worst, std::abs(slope(join.p.polygon, x, inward) - slope(join.q.polygon, x, image)));
    }
  }
  // Central differences: third derivatives of some 100 times h^2, and eps / h.
  CHECK(worst < 1e-8);
}

}  // namespace rondure
