// Curves on the sphere: interpolation, circular splines, B-splines (Dietz, Hoschek, Juettler 1993).
#include "renderer/projective/sphere_curve.h"

#include <fmt/format.h>

#include "renderer/projective/bspline.h"
#include "renderer/projective/sphere_arc.h"
#include "tests/catch.h"
#include "tests/projective/random_arcs.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// De Casteljau.
lvec4 at(std::vector<lvec4> c, long double t) {
  while (c.size() > 1) {
    for (std::size_t k = 0; k + 1 < c.size(); ++k) c[k] = (1 - t) * c[k] + t * c[k + 1];
    c.pop_back();
  }
  return c[0];
}

lvec3 curve_point(const lvec4& x) { return lvec3(x) / x.w; }

// The largest difference of control points that may have a common factor.
double off(const std::vector<lvec4>& a, const std::vector<lvec4>& b) {
  if (a.size() != b.size()) return INFINITY;
  long double ab = 0, bb = 0, most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) ab += glm::dot(a[k], b[k]), bb += glm::dot(b[k], b[k]);
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, glm::length(a[k] - (ab / bb) * b[k]));
  return static_cast<double>(most / std::sqrt(bb));
}

}  // namespace

TEST_CASE("circles through three points", "[projective]") {
  NetMaker make(71);
  WorstCase worst;
  for (int k = 0; k < 100; ++k) {
    const lvec3 p = direction(make), r = direction(make), q = direction(make);
    const SphereArc arc = arc_through(p, r, q);
    const double scale = static_cast<double>(1 / (glm::length(p - r) * glm::length(q - r)));
    worst.add(off(curve_image(circle_through(p, r, q)), {{arc.p, 1}, {arc.b, arc.w}, {arc.q, 1}}),
              1e-17 * (1 + scale), [&] { return fmt::format("circle {}", k); });
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("2n + 1 points have a curve of degree 2n (theorem 3.13)", "[projective]") {
  NetMaker make(72);
  WorstCase worst;
  for (int k = 0; k < 100; ++k) {
    const std::size_t n = 1 + static_cast<std::size_t>(k % 6);
    std::vector<lvec3> points;
    std::vector<long double> parameters;
    for (std::size_t i = 0; i <= 2 * n; ++i) {
      points.push_back(direction(make));
      parameters.push_back((static_cast<long double>(i) + make.uniform(-0.2, 0.2)) /
                           static_cast<long double>(2 * n));
    }
    const Interpolation found = interpolate(points, parameters);
    REQUIRE(found.preimage.size() == n + 1);
    CHECK(found.inaccessible.empty());
    CHECK(found.condition > 0);
    const std::vector<lvec4> curve = curve_image(found.preimage);
    CHECK(curve.size() == 2 * n + 1);
    for (std::size_t i = 0; i <= 2 * n; ++i) {
      // The equations hold to rounding of the control points (length 1 in all), which counts the more the
      // smaller the preimage is there.
      const double size = static_cast<double>(glm::length(at(found.preimage, parameters[i])));
      worst.add(static_cast<double>(glm::length(curve_point(at(curve, parameters[i])) - points[i])),
                1e-17 / size + 1e-17 / (size * size),
                [&] { return fmt::format("curve {}, point {}", k, i); });
    }
    // Unique: a curve through its own points is found again.
    std::vector<lvec3> again;
    for (const long double t : parameters) again.push_back(glm::normalize(curve_point(at(curve, t + 0.01L))));
    std::vector<long double> shifted = parameters;
    for (long double& t : shifted) t += 0.01L;
    const Interpolation same = interpolate(again, shifted);
    worst.add(off(curve_image(same.preimage), curve), 1e-15 / static_cast<double>(same.condition),
              [&] { return fmt::format("curve {} again", k); });
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("the reference's quartic through five points", "[projective]") {
  const std::vector<lvec3> points{{0, 0, -1},
                                  {1 / 3.0L, 2 / 3.0L, -2 / 3.0L},
                                  {6 / 7.0L, 2 / 7.0L, 3 / 7.0L},
                                  {1 / 9.0L, 4 / 9.0L, 8 / 9.0L},
                                  {-2 / 3.0L, 1 / 3.0L, 2 / 3.0L}};
  const Interpolation found = interpolate(points, {0, 0.25L, 0.5L, 0.75L, 1});
  const std::vector<lvec4> preimage{{176 / 109.0L, 0, 0, 31 / 109.0L},
                                    {-973 / 654.0L, 137 / 327.0L, 223 / 654.0L, -499 / 654.0L},
                                    {1, -2, 1, 0}};
  CHECK(off(curve_image(found.preimage), curve_image(preimage)) < 1e-16);
  CHECK(found.condition > 1e-3L);
}

TEST_CASE("inaccessible points are named", "[projective]") {
  // Four points along the unit speed of one circle, and one off it: the quartic is that circle with a common
  // factor.
  const std::vector<lvec4> circle = curve_image(circle_through({1, 0, 0}, {0, 1, 0}, {-0.6L, 0.8L, 0}));
  std::vector<lvec3> points;
  const std::vector<long double> parameters{0, 0.25L, 0.5L, 0.75L, 1};
  for (const long double t : parameters) points.push_back(glm::normalize(curve_point(at(circle, t))));
  points[3] = {0, 0, 1};
  const Interpolation found = interpolate(points, parameters);
  CHECK(found.inaccessible == std::vector<std::size_t>{3});
}

TEST_CASE("circular splines are smooth (equation 36)", "[projective]") {
  NetMaker make(73);
  WorstCase worst;
  for (int k = 0; k < 60; ++k) {
    std::vector<lvec3> points;
    for (int i = 0; i < 7; ++i) points.push_back(direction(make));
    const lvec3 on_first = direction(make);
    const CircularSpline spline = circular_spline(points, on_first);
    REQUIRE(spline.preimage.size() == points.size());
    REQUIRE(spline.intervals.size() == points.size() - 1);
    for (std::size_t i = 0; i < points.size(); ++i)
      worst.add(static_cast<double>(glm::length(curve_point(delta(spline.preimage[i])) - points[i])), 1e-17,
                [&] { return fmt::format("spline {}, point {}", k, i); });
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const lvec4 &before = spline.preimage[i - 1], &here = spline.preimage[i],
                  &after = spline.preimage[i + 1];
      // Equation (36), and the derivatives of the points: their directions agree, with the intervals their
      // lengths as well.
      const long double in = glm::dot(before, bar(here)), in_perp = glm::dot(before, perp(bar(here)));
      const long double out = glm::dot(after, bar(here)), out_perp = glm::dot(after, perp(bar(here)));
      const auto text = [&] { return fmt::format("spline {}, joint {}", k, i); };
      worst.add(static_cast<double>(std::abs(in * out_perp - in_perp * out)), 1e-17, text);
      CHECK(in * out + in_perp * out_perp < 0);
      const lvec4 middle = delta(here);
      const auto derivative = [&](const lvec4& other) {  // at `here`, towards `other`
        const lvec4 d = 2.0L * (delta(here, other) - middle);
        return (lvec3(d) - d.w * curve_point(middle)) / middle.w;
      };
      const lvec3 end = -derivative(before) / spline.intervals[i - 1];
      const lvec3 start = derivative(after) / spline.intervals[i];
      worst.add(static_cast<double>(glm::length(end - start) / glm::length(end)), 1e-15, text);
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("the reference's circular spline", "[projective]") {
  const auto unit = [](long double x, long double y, long double z) {
    return glm::normalize(lvec3(x, y, z));
  };
  const CircularSpline spline = circular_spline(
      {unit(1, 0, 0), unit(2, 2, 1), unit(0, 1, 1), unit(-3, 3, 1), unit(-1, -1, 1), unit(1, -4, 2)},
      unit(10, 5, 1));
  const long double intervals[] = {
      1, 0.9373791423113474775292843362209166093592L, 1.026324971162082532531494008676750304845L,
      1.613270061979855515982347871651201497790L, 1.053649673731199835143290610557387953229L};
  for (std::size_t k = 0; k < 5; ++k) CHECK(std::abs(spline.intervals[k] - intervals[k]) < 1e-16L);
  // The middle of the fourth arc.
  const lvec4 expected(
      0.1647253565478207896454095161995562223296L, -0.1876828666981467027959509987054388428131L,
      -0.7351914575097418708467292353754786979720L, -0.4112084612339485496361846987538061209045L);
  CHECK(glm::length(delta(spline.preimage[3], spline.preimage[4]) - expected) < 1e-16L);
}

TEST_CASE("the reference's B-spline curve", "[projective]") {
  const long double third = 1 / 3.0L;
  const BSpline preimage{
      2,
      {0, 0, 0, 1, 2, 2.5L, 4, 4, 4},
      {{1, 0, 0, 0}, {1, 1, 0, 0.5L}, {1, 1, 1, 0}, {0.5L, 0, 2, -0.5L}, {1, -1, 1, third}, {2, -1, 0, 0}}};
  CHECK(knot_defect(2, preimage.knots, 6).empty());
  const BSpline image = sphere_image(preimage);
  CHECK(image.degree == 4);
  CHECK(image.knots ==
        std::vector<long double>{0, 0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2.5L, 2.5L, 2.5L, 4, 4, 4, 4, 4});
  const std::vector<lvec4> expected{
      {0, 0, -1, 1},
      {1, 0, -1, 1},
      {5 / 3.0L, 5 / 6.0L, -0.5L, 11 / 6.0L},
      {1.75L, 1.25L, -0.125L, 2.125L},
      {1.75L, 1.75L, 0.5L, 2.5L},
      {19 / 12.0L, 23 / 12.0L, 31 / 36.0L, 31 / 12.0L},
      {4 / 3.0L, 2, 4 / 3.0L, 8 / 3.0L},
      {5 / 3.0L, 2, 17 / 6.0L, 23 / 6.0L},
      {46 / 27.0L, 2.064814814814814814814814814814814815L, 3.106481481481481481481481481481481481L,
       4.115740740740740740740740740740740741L},
      {4 / 3.0L, 2.25L, 73 / 24.0L, 95 / 24.0L},
      {-7 / 6.0L, 31 / 12.0L, 53 / 36.0L, 91 / 36.0L},
      {-155 / 72.0L, 155 / 72.0L, 7 / 27.0L, 139 / 54.0L},
      {-3, 5 / 3.0L, -1, 3},
      {-4, 0, -3, 5}};
  REQUIRE(image.points.size() == expected.size());
  long double most = 0;
  for (std::size_t k = 0; k < expected.size(); ++k)
    most = std::max(most, glm::length(image.points[k] - expected[k]));
  CHECK(most < 1e-17L);
}

TEST_CASE("images of B-splines are pieces of delta, and as smooth as their preimages", "[projective]") {
  NetMaker make(74);
  WorstCase worst;
  for (int round = 0; round < 40; ++round) {
    const int d = 1 + round % 4;
    BSpline preimage{d, {}, {}};
    const std::size_t count = static_cast<std::size_t>(d) + 4;
    for (std::size_t k = 0; k < count; ++k) preimage.points.push_back(make.point(-1.0, 1.0));
    for (std::size_t k = 0; k < count + static_cast<std::size_t>(d) + 1; ++k)
      preimage.knots.push_back(static_cast<long double>(std::clamp<std::ptrdiff_t>(
          static_cast<std::ptrdiff_t>(k) - d, 0, static_cast<std::ptrdiff_t>(count) - d)));
    for (long double& t : preimage.knots) t = t * t + t;  // not equidistant
    REQUIRE(knot_defect(d, preimage.knots, count).empty());
    const BSpline image = sphere_image(preimage);
    CHECK(knot_defect(2 * d, image.knots, image.points.size()).empty());
    const auto text = [&] { return fmt::format("spline {} of degree {}", round, d); };
    for (const std::size_t span : spans_of(d, preimage.knots, count)) {
      const long double a = preimage.knots[span], b = preimage.knots[span + 1];
      const long double t = a + (b - a) * static_cast<long double>(make.uniform(0, 1));
      const std::vector<lvec4> piece = bezier_piece(preimage, span);
      const lvec4 expected = delta(at(piece, (t - a) / (b - a)));
      // The image as a B-spline of its own.
      for (const std::size_t k : spans_of(2 * d, image.knots, image.points.size())) {
        if (!(image.knots[k] <= a && b <= image.knots[k + 1])) continue;
        const std::vector<long double> diagonal(static_cast<std::size_t>(2 * d), t);
        worst.add(static_cast<double>(glm::length(blossom(image, k, diagonal) - expected)), 1e-15, text);
      }
      // Derivatives of the two pieces at the next knot, up to order d - 1: blossoms that differ in at most
      // d - 1 arguments from the knot agree.
      if (span + 2 >= preimage.knots.size() - static_cast<std::size_t>(d)) continue;
      for (int r = 0; r < d; ++r) {
        std::vector<long double> arguments(static_cast<std::size_t>(d), b);
        for (int k = 0; k < r; ++k) arguments[static_cast<std::size_t>(k)] = b + 0.5L;
        worst.add(static_cast<double>(glm::length(blossom(preimage, span, arguments) -
                                                  blossom(preimage, span + 1, arguments))),
                  1e-15, text);
      }
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("bad knots are named", "[projective]") {
  CHECK(knot_defect(2, {0, 0, 0, 1, 1, 1}, 3).empty());
  CHECK(knot_defect(2, {0, 0, 0, 1, 1}, 3).find("need 6 knots") != std::string::npos);
  CHECK(knot_defect(2, {0, 0, 1, 0.5L, 1, 1}, 3).find("less than the one before") != std::string::npos);
  CHECK(knot_defect(1, {0, 0, 0, 1, 1, 1}, 4).find("repeated more than 2") != std::string::npos);
  CHECK(knot_defect(2, {0, 0, 0, 1, 1, 1, 2, 2, 2}, 6).find("tear") != std::string::npos);
  CHECK(knot_defect(2, {0, 0, 0, 0, 1}, 2) != "");
}

}  // namespace rondure
