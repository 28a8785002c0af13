// Regularity, proved in doubles and exactly, and singular points found.
#include "renderer/continuity/regularity.h"

#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/complex/exact_regularity.h"
#include "renderer/complex/octahedron_bases.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"

namespace rondure {
namespace {

using Verdict = Regularity::Verdict;

BlendPoint at(int x, int y, int z) { return {{Exact(x), Exact(y), Exact(z)}, 1}; }

// Equation 3.2 with control points 6, 5, 7 of Figure 3.
std::vector<ExactPatch> cubic(const BlendPoint& six, const BlendPoint& five, const BlendPoint& seven) {
  const std::vector<BlendPoint> points = {at(1, 1, 1), at(1, 1, -1), at(1, -1, 1), at(1, -1, -1),
                                          five,        six,          seven,        at(-1, -1, -1)};
  return blend(octahedron_splines(3), points, false);
}

std::vector<ExactPatch> rational(const std::vector<BlendPoint>& points) {
  return blend(octahedron_rationals(), points, false);
}

Surface figure_3d() {
  return build_family(
      R"({"type": "gc_octahedron", "control_points": {"h6": [-2, 1, 0], "h5": [0, 0, 0], "h7": [1, -2, -1]}})");
}

// The least |Su x Sv| on a grid.
double sampled_least(const Surface& surface, int cells) {
  double least = INFINITY;
  for (const Net& net : surface.patches) {
    const bool triangle = std::holds_alternative<TriangleNet>(net);
    for (int i = 0; i <= cells; ++i) {
      for (int j = 0; j <= (triangle ? cells - i : cells); ++j) {
        const SurfaceJet jet =
            surface_jet(net, static_cast<double>(i) / cells, static_cast<double>(j) / cells);
        least = std::fmin(least, glm::length(glm::cross(jet.du, jet.dv)));
      }
    }
  }
  return least;
}

// (t^2, t^3, v) with t = u - shift: a cusp along the line u = shift.
Surface cusp(double shift) {
  TensorNet net(3, 1);
  for (int j = 0; j <= 1; ++j) {
    // Blossoms of t^2 and t^3 at 0 (3 - i times) and 1 (i times).
    for (int i = 0; i <= 3; ++i) {
      const double a[3] = {(i > 0 ? 1 : 0) - shift, (i > 1 ? 1 : 0) - shift, (i > 2 ? 1 : 0) - shift};
      net.at(i, j) = dvec4((a[0] * a[1] + a[0] * a[2] + a[1] * a[2]) / 3.0, a[0] * a[1] * a[2], j, 1);
    }
  }
  Surface surface;
  surface.patches.emplace_back(net);
  return surface;
}

}  // namespace

TEST_CASE("the open question: eight regular patches over u^2 + v^2 + w^2, in exact arithmetic",
          "[regularity]") {
  // Both cyclically symmetric: A, F, B, E, C, D and the three products.
  const ExactRegularity simplest =
      exact_regularity(rational({at(0, -2, 1), at(1, 0, -2), at(-2, 1, 0), at(7, 0, -4), at(0, -4, 7),
                                 at(-4, 7, 0), at(2, 0, 0), at(0, 2, 0), at(0, 0, 2)}));
  CHECK(simplest.certified);
  CHECK(simplest.pieces > 100);
  const ExactRegularity round =
      exact_regularity(rational({at(-2, -8, 1), at(1, -2, -8), at(-8, 1, -2), at(27, 6, -6), at(6, -6, 27),
                                 at(-6, 27, 6), at(10, 4, 4), at(4, 10, 4), at(4, 4, 10)}));
  CHECK(round.certified);
  // A mirror makes two vertices singular: A and F with x -> -x.
  const ExactRegularity mirrored =
      exact_regularity(rational({at(2, 0, 0), at(0, 3, 1), at(0, 0, 2), at(0, 1, -2), at(0, -2, 1),
                                 at(-2, 0, 0), at(0, 1, 1), at(1, 0, 0), at(2, 0, 0)}),
                       20, 2000);
  CHECK_FALSE(mirrored.certified);
}

TEST_CASE("Figure 3: (a), (b), (c) are regular, (d) is so only with other signs", "[regularity]") {
  const BlendPoint six = at(-1, 1, -1), five = at(-1, 1, 1), seven = at(-1, -1, 1);
  CHECK(exact_regularity(cubic(six, five, seven)).certified);
  CHECK(exact_regularity(cubic(at(-2, 1, 0), five, seven)).certified);
  CHECK(exact_regularity(cubic(at(-2, 1, 0), at(0, 0, 0), seven)).certified);
  const auto last = [&](int x, int y, int z) {
    return exact_regularity(cubic(at(-2, 1, 0), at(0, 0, 0), at(x, y, z)), 24, 5000).certified;
  };
  CHECK_FALSE(last(1, -2, -1));
  CHECK(last(-1, -2, 1));
  CHECK(last(1, -2, 1));
  CHECK(last(-1, -2, -1));
}

TEST_CASE("the cross-caps of Figure 3 (d) are found", "[regularity]") {
  const Surface surface = figure_3d();
  const Regularity r = regularity_of(surface);
  CHECK(r.verdict == Verdict::singular);
  REQUIRE(r.singular.size() == 2);
  // Known to 12 digits; triangle 3 is mirrored, u and v exchanged.
  CHECK(r.singular[0].patch == 2);
  CHECK(std::abs(r.singular[0].u - 0.447842876926) < 1e-12);
  CHECK(std::abs(r.singular[0].v - 0.142384548227) < 1e-12);
  CHECK(r.singular[1].patch == 7);
  CHECK(std::abs(r.singular[1].u - 0.582178269665) < 1e-12);
  CHECK(std::abs(r.singular[1].v - 0.403543360584) < 1e-12);
  for (const SingularPoint& s : r.singular) {
    const SurfaceJet jet = surface_jet(surface.patches[static_cast<std::size_t>(s.patch)], s.u, s.v);
    CHECK(glm::length(glm::cross(jet.du, jet.dv)) < 1e-11 * r.largest_found);
    CHECK(glm::distance(jet.point, s.point) < 1e-13);
  }
}

TEST_CASE("the proved least |Su x Sv| is below all samples and half of the least of them", "[regularity]") {
  for (const char* text :
       {R"({"type": "gc_octahedron"})", R"({"type": "gc_octahedron", "basis": "rational"})",
        R"({"type": "gc_octahedron", "basis": "sphere"})", R"({"type": "sphere_tiling"})",
        R"({"type": "gc_complex", "complex": "torus"})"}) {
    CAPTURE(text);
    const Surface surface = build_family(text);
    const Regularity r = regularity_of(surface);
    CHECK(r.verdict == Verdict::regular);
    CHECK(r.collapsed == 0);
    const double sampled = sampled_least(surface, 24);
    CHECK(r.least <= sampled);
    CHECK(r.least >= 0.499 * r.least_found);
    CHECK(r.least_found <= r.largest_found);
    const Net& net = surface.patches[static_cast<std::size_t>(r.least_at.patch)];
    const SurfaceJet jet = surface_jet(net, r.least_at.u, r.least_at.v);
    CHECK(glm::length(glm::cross(jet.du, jet.dv)) == r.least_found);
  }
}

TEST_CASE("singular parameters of spheres, collapsed sides and cusps are told apart", "[regularity]") {
  // Octants with one side that is a point.
  const Regularity octant = regularity_of(build_family(R"({"type": "sphere_octant", "octants": [0]})"));
  CHECK(octant.verdict == Verdict::regular);
  CHECK(octant.collapsed == 1);
  CHECK(octant.least == 0.0);
  // Parallel tangents at the corners of a hemisphere.
  const Regularity hemisphere = regularity_of(build_family(R"({"type": "sphere_cap", "z_max": 0})"));
  CHECK(hemisphere.verdict == Verdict::singular);
  CHECK(hemisphere.singular.size() == 4);
  // (u, v) -> (u^2, u^3, v) has a cusp along u = 0, and (u - 1/2)^2, (u - 1/2)^3 one within, along a line.
  CHECK(regularity_of(cusp(0.0), 5000).collapsed == 1);
  const Regularity inside = regularity_of(cusp(0.5), 5000);
  CHECK(inside.verdict != Verdict::regular);
  CHECK(inside.least_found == 0.0);
  CHECK(regularity_of(build_family(R"({"type": "sphere"})")).verdict == Verdict::undecided);
}

TEST_CASE("singular lines are found wherever they run", "[regularity]") {
  for (const double shift : {1.0 / 3.0, 0.37, 0.7071}) {
    const Regularity r = regularity_of(cusp(shift), 20000);
    CAPTURE(shift);
    CHECK(r.verdict == Verdict::singular);
    REQUIRE_FALSE(r.singular.empty());
    for (const SingularPoint& s : r.singular) CHECK(std::abs(s.u - shift) < 1e-9);
  }
}

TEST_CASE("the largest |Su x Sv| that is told is near the largest", "[regularity]") {
  const Surface sphere = build_family(R"({"type": "gc_octahedron", "basis": "sphere"})");
  const Regularity r = regularity_of(sphere);
  double largest = 0.0;
  for (int i = 0; i <= 40; ++i) {
    for (int j = 0; j <= 40 - i; ++j) {
      const SurfaceJet jet = surface_jet(sphere.patches[0], i / 40.0, j / 40.0);
      largest = std::fmax(largest, glm::length(glm::cross(jet.du, jet.dv)));
    }
  }
  CHECK(largest > 3.7);
  CHECK(r.largest_found > 0.99 * largest);
  CHECK(r.least_found < 2.01);
}

}  // namespace rondure
