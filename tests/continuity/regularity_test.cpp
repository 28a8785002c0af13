// Regularity, proved in doubles and exactly, and singular points found.
#include "renderer/continuity/regularity.h"

#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/complex/complex_surface.h"
#include "renderer/complex/octahedron_bases.h"
#include "renderer/continuity/exact_regularity.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"

namespace rondure {
namespace {

using Verdict = Regularity::Verdict;

BlendPoint at(int x, int y, int z) { return {{Exact(x), Exact(y), Exact(z)}, 1}; }

// A surface whose nets are exactly the blended patches, times one number.
Surface exact_surface(const GcBasis& basis, const std::vector<BlendPoint>& points) {
  RoundedNets rounded = nets_of(blend(basis, points, false));
  CHECK(rounded.roundings == 0);
  Surface surface;
  surface.patches = std::move(rounded.nets);
  return surface;
}

// Equation 3.2 with control points 6, 5, 7 of Figure 3.
Surface cubic(const BlendPoint& six, const BlendPoint& five, const BlendPoint& seven) {
  const std::vector<BlendPoint> points = {at(1, 1, 1), at(1, 1, -1), at(1, -1, 1), at(1, -1, -1),
                                          five,        six,          seven,        at(-1, -1, -1)};
  return exact_surface(octahedron_splines(3), points);
}

Surface rational(const std::vector<BlendPoint>& points) {
  return exact_surface(octahedron_rationals(), points);
}

ExactRegularity certified(const Surface& surface, double most_work = 1e9) {
  return exact_regularity(surface, regularity_of(surface), most_work);
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
  for (const std::vector<BlendPoint>& points :
       {std::vector<BlendPoint>{at(0, -2, 1), at(1, 0, -2), at(-2, 1, 0), at(7, 0, -4), at(0, -4, 7),
                                at(-4, 7, 0), at(2, 0, 0), at(0, 2, 0), at(0, 0, 2)},
        {at(-2, -8, 1), at(1, -2, -8), at(-8, 1, -2), at(27, 6, -6), at(6, -6, 27), at(-6, 27, 6),
         at(10, 4, 4), at(4, 10, 4), at(4, 4, 10)}}) {
    const Surface surface = rational(points);
    const ExactRegularity proof = certified(surface);
    CHECK(proof.verdict == Verdict::regular);
    CHECK(proof.pieces > 100);
    // The same bound is reached with rounding, where pieces differ by little: both take half of the least
    // found.
    const Regularity rounded = regularity_of(surface);
    CHECK(proof.least >= 0.45 * rounded.least_found);
    CHECK(proof.least <= sampled_least(surface, 48));
  }
  // A mirror makes two vertices singular: A and F with x -> -x. They are corners, where nothing is rounded.
  const ExactRegularity mirrored =
      certified(rational({at(2, 0, 0), at(0, 3, 1), at(0, 0, 2), at(0, 1, -2), at(0, -2, 1), at(-2, 0, 0),
                          at(0, 1, 1), at(1, 0, 0), at(2, 0, 0)}));
  CHECK(mirrored.verdict == Verdict::singular);
  REQUIRE_FALSE(mirrored.singular.empty());
  bool corner = false;
  for (const ProvedZero& zero : mirrored.singular)
    corner = corner || (zero.within == 0.0 && (zero.at.u == 1.0 || zero.at.v == 1.0));
  CHECK(corner);
}

TEST_CASE("Figure 3: (a), (b), (c) are regular, (d) is so only with other signs", "[regularity]") {
  const BlendPoint six = at(-1, 1, -1), five = at(-1, 1, 1), seven = at(-1, -1, 1);
  CHECK(certified(cubic(six, five, seven)).verdict == Verdict::regular);
  CHECK(certified(cubic(at(-2, 1, 0), five, seven)).verdict == Verdict::regular);
  CHECK(certified(cubic(at(-2, 1, 0), at(0, 0, 0), seven)).verdict == Verdict::regular);
  const auto last = [&](int x, int y, int z) {
    return certified(cubic(at(-2, 1, 0), at(0, 0, 0), at(x, y, z)));
  };
  CHECK(last(-1, -2, 1).verdict == Verdict::regular);
  CHECK(last(1, -2, 1).verdict == Verdict::regular);
  CHECK(last(-1, -2, -1).verdict == Verdict::regular);
  const ExactRegularity printed = last(1, -2, -1);
  CHECK(printed.verdict == Verdict::singular);
  REQUIRE(printed.singular.size() == 2);
  // Known to 12 digits, in triangles as they are given.
  const double known[2][2] = {{0.142384548227, 0.447842876926}, {0.403543360584, 0.582178269665}};
  for (std::size_t k = 0; k < 2; ++k) {
    const ProvedZero& zero = printed.singular[k];
    CHECK(zero.at.patch == (k == 0 ? 2 : 7));
    CHECK(std::abs(zero.at.u - known[k][0]) <= zero.within + 5e-13);
    CHECK(std::abs(zero.at.v - known[k][1]) <= zero.within + 5e-13);
    CHECK(zero.within < 1e-12);
  }
}

TEST_CASE("exact proofs of regularity: nothing is proved that is not so, and work is bounded",
          "[regularity]") {
  // A zero at u = 1/3 of doubles that are not: neither regular nor singular in truth, to rounding.
  const Surface third = cusp(1.0 / 3.0);
  const ExactRegularity open = certified(third, 1e7);
  CHECK(open.verdict != Verdict::regular);
  // At 1/2 nothing is rounded, and the line of zeros is found.
  const ExactRegularity half = certified(cusp(0.5), 1e7);
  CHECK(half.verdict != Verdict::regular);
  // A side that is a cusp: proved but for that side.
  const ExactRegularity side = certified(cusp(0.0));
  CHECK(side.verdict == Verdict::regular);
  CHECK(side.collapsed == 1);
  CHECK(side.least == 0.0);
  // Just outside the patch.
  CHECK(certified(cusp(-1e-7)).verdict == Verdict::regular);
  const ExactRegularity poor =
      certified(rational({at(0, -2, 1), at(1, 0, -2), at(-2, 1, 0), at(7, 0, -4), at(0, -4, 7), at(-4, 7, 0),
                          at(2, 0, 0), at(0, 2, 0), at(0, 0, 2)}),
                1e3);
  CHECK(poor.verdict == Verdict::undecided);
  CHECK(poor.spent);
  CHECK_FALSE(poor.undecided.empty());
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
  CHECK(r.complete);
  for (const SingularPoint& s : r.singular) {
    CHECK(s.proof == SingularPoint::Proof::unique);
    CHECK(s.within < 1e-11);
    const SurfaceJet jet = surface_jet(surface.patches[static_cast<std::size_t>(s.patch)], s.u, s.v);
    CHECK(glm::length(glm::cross(jet.du, jet.dv)) < 1e-11 * r.largest_found);
    CHECK(glm::distance(jet.point, s.point) < 1e-13);
  }
}

// (s t, s, t^3 / 3 - e^2 t) with t = u - 1/3 and s = v - 2/5: cross-caps at s = 0, t = e and t = -e.
Surface two_cross_caps(double e) {
  TensorNet net(3, 1);
  for (int i = 0; i <= 3; ++i) {
    double t[3], linear = 0.0;
    for (int k = 0; k < 3; ++k) t[k] = (i > k ? 1 : 0) - 1.0 / 3.0, linear += t[k] / 3.0;
    for (int j = 0; j <= 1; ++j) {
      const double s = j - 0.4;
      net.at(i, j) = dvec4(s * linear, s, t[0] * t[1] * t[2] / 3.0 - e * e * linear, 1);
    }
  }
  Surface surface;
  surface.patches.emplace_back(net);
  return surface;
}

TEST_CASE("simple zeros are proved to be alone, and where they are said to be", "[regularity]") {
  for (const double e : {0.25, 0.05, 1e-3}) {
    CAPTURE(e);
    const Regularity r = regularity_of(two_cross_caps(e), 20000);
    CHECK(r.complete);
    REQUIRE(r.singular.size() == 2);
    for (const SingularPoint& s : r.singular) {
      CHECK(s.proof == SingularPoint::Proof::unique);
      CHECK(s.within < 1e-11 / e);
      const double t = s.u - 1.0 / 3.0;
      CHECK(glm::distance(dvec2(std::abs(t), s.v), dvec2(e, 0.4)) < s.within);
    }
    CHECK((r.singular[0].u - 1.0 / 3.0) * (r.singular[1].u - 1.0 / 3.0) < 0.0);
  }
  // They have become one of another kind, of which Kantorovich's theorem knows nothing.
  const Regularity both = regularity_of(two_cross_caps(0.0), 20000);
  CHECK_FALSE(both.complete);
  CHECK(both.verdict == Verdict::singular);
  for (const SingularPoint& s : both.singular) CHECK(s.proof == SingularPoint::Proof::none);
  // Without any: the sign of e^2 turned around.
  Surface none = two_cross_caps(0.0);
  for (dvec4& p : points_of(none.patches[0])) p.z += 0.01 * p.x;
  for (int i = 0; i <= 3; ++i)
    for (int j = 0; j <= 1; ++j)
      std::get<TensorNet>(none.patches[0]).at(i, j).z += 1e-4 * (i / 3.0 - 1.0 / 3.0);
  CHECK(regularity_of(none, 20000).verdict == Verdict::regular);
}

TEST_CASE("zeros at corners are exact, and all that there are", "[regularity]") {
  for (const char* text : {R"({"type": "sphere_cap", "z_max": 0})",
                           R"({"type": "sphere_tiling", "topology": "octahedron_pairs"})",
                           R"({"type": "sphere_tiling", "topology": "hemispheres"})"}) {
    CAPTURE(text);
    const Regularity r = regularity_of(build_family(text), 20000);
    CHECK(r.complete);
    CHECK(r.pieces < 100);
    for (const SingularPoint& s : r.singular) {
      CHECK(s.proof == SingularPoint::Proof::exact);
      CHECK((s.u == 0.0 || s.u == 1.0));
      CHECK((s.v == 0.0 || s.v == 1.0));
    }
  }
  CHECK_FALSE(regularity_of(cusp(0.5), 5000).complete);
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
