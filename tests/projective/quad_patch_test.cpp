// The general tool: shapes of quadrilaterals, the best centre, regularity.
#include "renderer/projective/quad_patch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/bezier/rational.h"
#include "renderer/projective/planar_jacobian.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

lvec3 direction(double x, double y, double z) { return glm::normalize(lvec3(x, y, z)); }

// The cube's face about +x, counter-clockwise from outside.
std::array<lvec3, 4> cube_face() {
  return {direction(1, -1, -1), direction(1, 1, -1), direction(1, 1, 1), direction(1, -1, 1)};
}

// A convex quadrilateral of great circles about the z axis, turned by random angles; false when three corners
// are nearly in line.
bool random_quad(NetMaker& make, std::array<lvec3, 4>& corners) {
  double angle[4];
  for (double& a : angle) a = make.uniform(0.0, 6.283185307179586);
  std::sort(angle, angle + 4);
  const double height = make.uniform(-0.3, 0.95);
  const StereographicFrame frame(direction(make.uniform(-1.0, 1.0), make.uniform(-1.0, 1.0), 0.3));
  for (int k = 0; k < 4; ++k) {
    const double flat = std::sqrt(1.0 - height * height);
    const lvec3 p(flat * std::cos(angle[k]), flat * std::sin(angle[k]), height);
    corners[static_cast<std::size_t>(k)] =
        glm::normalize(frame.e1 * p.x + frame.e2 * p.y + frame.centre * p.z);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const lvec3 &a = corners[k], &b = corners[(k + 1) % 4], &c = corners[(k + 2) % 4];
    if (!(glm::dot(glm::cross(a, b), c) > 0.02L) || glm::length(a + b) < 0.2L) return false;
  }
  return true;
}

double least_margin(const SphericalQuad& quad, const lvec3& c) {
  long double least = 2;
  for (const SphereArc& arc : quad.arc) {
    const lvec3 inside = (arc.p + 2.0L * arc.b + arc.q) / (2 + 2 * arc.w);
    const lvec3 normal = glm::normalize(glm::cross(inside - arc.p, arc.q - inside));
    least = std::min({least, 1 + glm::dot(arc.p, c), glm::dot(normal, c) + glm::dot(normal, arc.p)});
  }
  return static_cast<double>(least);
}

}  // namespace

TEST_CASE("angles and bends are those of known quadrilaterals", "[projective]") {
  const SphericalQuad face = geodesic_quad(cube_face());
  const QuadShape about_middle = shape_of(face, direction(1, 0, 0));
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(static_cast<double>(about_middle.angle[k]) == Approx(120.0).epsilon(1e-15));
    // Four turns of 60 degrees at the corners leave 30 to each arc.
    CHECK(static_cast<double>(about_middle.bend[k]) == Approx(30.0).epsilon(1e-15));
  }
  CHECK_FALSE(defect_of(about_middle, false).has_value());

  // Seen from the north pole the corners are as they were, but the upper or lower side bends inward: angles
  // alone do not decide.
  const QuadShape about_pole = shape_of(face, direction(0, 0, -1));
  CHECK(static_cast<double>(about_pole.angle[0]) == Approx(120.0).epsilon(1e-15));
  CHECK(static_cast<double>(about_pole.bend[0]) == Approx(-30.0).epsilon(1e-15));
  const auto defect = defect_of(about_pole, false);
  REQUIRE(defect.has_value());
  CHECK(defect->part == QuadDefect::Part::arc);
  CHECK(defect->index == 0);
  CHECK(defect->text ==
        "arcs[0], from corners[0] to corners[1], bends inward by 30 degrees in the plane, so "
        "that the image is not convex");

  // The same region listed clockwise is the rest of the sphere.
  std::array<lvec3, 4> reversed = cube_face();
  std::reverse(reversed.begin(), reversed.end());
  const auto outside = defect_of(shape_of(geodesic_quad(reversed), direction(1, 0, 0)), false);
  REQUIRE(outside.has_value());
  CHECK(outside->text ==
        "corners[0] has an interior angle of 240 degrees; with more than 180 no image in a "
        "plane is convex (corners are listed counter-clockwise, seen from outside)");
}

TEST_CASE("each defect is found", "[projective]") {
  const auto text = [](const SphericalQuad& quad, const lvec3& centre, bool straight = false) {
    const auto defect = defect_of(shape_of(quad, centre), straight);
    return defect ? defect->text : std::string("none");
  };
  // Two octants joined: a straight angle.
  const SphericalQuad lune =
      geodesic_quad({direction(0, 0, -1), direction(0, 1, 0), direction(0, 0, 1), direction(1, 0, 0)});
  CHECK(text(lune, direction(1, 1, 0)) ==
        "corners[1] has an interior angle of 180 degrees, where the patch would be singular; it must be less "
        "than 180");
  CHECK(text(lune, direction(1, 1, 0), true) == "none");
  // One projects from a corner.
  const SphericalQuad face = geodesic_quad(cube_face());
  CHECK(text(face, -direction(1, 1, 1)) == "corners[2] lies where one projects from, opposite the centre");
  // A side of 150 degrees, seen from the other end: in the plane it is more than half a circle.
  const auto near_equator = [](double longitude) {
    const double a = longitude * 0.017453292519943295;
    return direction(std::cos(a), std::sin(a), 0.1);
  };
  const SphericalQuad wide =
      geodesic_quad({near_equator(-75), near_equator(75), near_equator(150), near_equator(210)});
  CHECK(text(wide, direction(-1, 0, 0.2)).find("arcs[0], from corners[0] to corners[1], turns by ") == 0);
  CHECK(text(wide, best_centre(wide)) == "none");
  // A bow tie.
  const std::array<lvec3, 4> tie = {direction(1, -1, -1), direction(1, 1, 1), direction(1, 1, -1),
                                    direction(1, -1, 1)};
  CHECK(text(geodesic_quad(tie), direction(1, 0, 0)).find("has an interior angle of ") != std::string::npos);
}

TEST_CASE("convex quadrilaterals of great circles are regular about the best centre", "[projective]") {
  NetMaker make(17);
  int quads = 0, bad = 0, doubled = 0, beaten = 0;
  WorstCase sphere;
  for (int k = 0; k < 400; ++k) {
    std::array<lvec3, 4> corners;
    if (!random_quad(make, corners)) continue;
    ++quads;
    const SphericalQuad quad = geodesic_quad(corners);
    const lvec3 centre = best_centre(quad);
    const double margin = least_margin(quad, centre);
    for (int j = 0; j < 200; ++j) {
      const lvec3 other =
          direction(make.uniform(-1.0, 1.0), make.uniform(-1.0, 1.0), make.uniform(-1.0, 1.0));
      if (least_margin(quad, other) > margin + 1e-12) ++beaten;
    }
    if (defect_of(shape_of(quad, centre), false)) ++bad;
    for (const CornerWeights weights : {CornerWeights::unit, CornerWeights::matched}) {
      QuadPatchOptions options;
      options.centre = centre;
      options.corner_weights = weights;
      const QuadPatch patch = quad_patch(quad, options);
      if (!patch.regular) ++bad;
      doubled += patch.doublings;
      options.middle_weight = 1e-6L;
      options.may_double = false;
      if (!quad_patch(quad, options).regular) ++bad;
      for (int c = 0; c < 4; ++c) {
        const dvec3 p = net_point(patch.net, c == 1 || c == 2, c >= 2);
        const dvec3 given(quad.corner(c));
        // Rounding of the net and of four coordinates.
        sphere.add(glm::length(p - given), 4 * 0x1p-52, [&] { return fmt::format("quad {}", k); });
      }
    }
  }
  INFO(sphere.text());
  CHECK(quads > 60);
  CHECK(bad == 0);
  CHECK(beaten == 0);
  // In more than 100,000 trials, with arcs of small circles too, no weight was ever too small.
  CHECK(doubled == 0);
  CHECK(sphere.failures() == 0);
}

TEST_CASE("regions that are regular about some centre are so about the best one", "[projective]") {
  // Images of convex quadrilaterals of arcs in the plane, from a few degrees wide to nearly the whole sphere.
  NetMaker make(29);
  int regions = 0, refused = 0;
  std::string first;
  for (const double radius : {0.1, 1.0, 2.0, 4.0, 10.0, 40.0}) {
    for (int k = 0; k < 40; ++k) {
      std::array<lvec3, 4> corner, bulge;
      double at[4];
      for (int j = 0; j < 4; ++j) at[j] = 1.5707963267948966 * (j + make.uniform(-0.3, 0.3));
      const auto lifted = [](double x, double y) {
        // From the plane z = -1 towards the north pole; seen from outside, so from below, y points the other
        // way.
        return direction(4 * x, -4 * y, x * x + y * y - 4);
      };
      for (std::size_t j = 0; j < 4; ++j)
        corner[j] = lifted(radius * std::cos(at[j]), radius * std::sin(at[j]));
      for (std::size_t j = 0; j < 4; ++j) {
        // Between the chord's middle and the circle about the origin: no arc bends inward.
        const double next = at[(j + 1) % 4] + (j == 3 ? 6.283185307179586 : 0.0), half = 0.5 * (next - at[j]);
        const double reach = radius * (std::cos(half) + make.uniform(0.1, 0.8) * (1 - std::cos(half)));
        bulge[j] = lifted(reach * std::cos(at[j] + half), reach * std::sin(at[j] + half));
      }
      SphericalQuad quad;
      for (std::size_t j = 0; j < 4; ++j) quad.arc[j] = arc_through(corner[j], bulge[j], corner[(j + 1) % 4]);
      if (defect_of(shape_of(quad, direction(0, 0, -1)), false)) continue;
      ++regions;
      if (const auto defect = defect_of(shape_of(quad, best_centre(quad)), false)) {
        if (refused++ == 0) first = fmt::format("radius {}: {}", radius, defect->text);
      }
    }
  }
  INFO("first refused: " << first);
  CHECK(regions > 200);
  CHECK(refused == 0);
}

TEST_CASE("the planar Jacobian is the tabulated one", "[projective]") {
  // Figure 4, middle weight 1: exact values a + b sqrt(2) + c sqrt(3) + d sqrt(6).
  const double r2 = std::sqrt(2.0), r3 = std::sqrt(3.0), r6 = std::sqrt(6.0);
  const double corner = 12 - 8 * r3, next = 7 * r2 - 5 * r6, side = (28 * r3 - 56) / 3, inner = 6 * r3 - 13,
               axis = (22 * r2 - 16 * r6) / 3, middle = 16 * r3 / 3 - 12;
  const double half[3][3] = {{corner, next, side}, {next, inner, axis}, {side, axis, middle}};
  const TensorPolynomial<long double> d = planar_jacobian(cube_square(1));
  REQUIRE(d.m == 4);
  REQUIRE(d.n == 4);
  double worst = 0.0;
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 4; ++j) {
      const double expected = half[std::min(i, 4 - i)][std::min(j, 4 - j)];
      worst = std::max(worst, std::abs(static_cast<double>(d.at(i, j)) - expected));
    }
  }
  // The expected values cancel to a quarter of their terms.
  CHECK(worst < 64 * 0x1p-52);
}

TEST_CASE("a middle weight that folds a patch is doubled until it does not", "[projective]") {
  // (x, y, weight), found by trying; the middle one hardly counts, and the sides bend to and fro. Of convex
  // quadrilaterals of arcs none is known that needs this.
  const long double points[3][3][3] = {{{0.15L, 0.02L, 0.49L}, {-0.08L, 0.52L, 0.18L}, {0.11L, 0.72L, 0.31L}},
                                       {{0.63L, -0.36L, 1.1L}, {0.5L, 0.5L, 0.001L}, {0.84L, 0.97L, 0.17L}},
                                       {{1.2L, 0.35L, 3.8L}, {0.67L, 0.39L, 0.31L}, {1.25L, 1.27L, 2}}};
  PlanarBiquadratic patch{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const long double(&p)[3] = points[i][j];
      patch.x[i][j] = p[0] * p[2], patch.y[i][j] = p[1] * p[2], patch.w[i][j] = p[2];
    }
  }
  const long double start = patch.w[1][1];
  CHECK_FALSE(certainly_regular(patch, false));
  CHECK_FALSE(double_until_regular(patch, false, 1).has_value());
  const auto more = double_until_regular(patch, false, 40);
  REQUIRE(more.has_value());
  CHECK(*more > 0);
  // The two that were in vain left two doublings behind.
  CHECK(patch.w[1][1] == start * std::ldexp(1.0L, 2 + *more));
  CHECK(certainly_regular(patch, false));
  // A middle control point close to a corner and heavy folds the patch, and more so the heavier it is.
  patch.x[1][1] = 300 * 0.16L, patch.y[1][1] = 300 * 0.16L, patch.w[1][1] = 300;
  CHECK_FALSE(certainly_regular(patch, false));
  CHECK_FALSE(double_until_regular(patch, false, 20).has_value());
}

}  // namespace rondure
