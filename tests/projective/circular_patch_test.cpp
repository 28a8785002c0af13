// Patches between circular arcs (Dietz, Hoschek, Juettler 1993, section 3.5).
#include "renderer/projective/circular_patch.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/triangle.h"
#include "renderer/projective/orientation.h"
#include "tests/catch.h"
#include "tests/projective/off_arcs.h"
#include "tests/projective/random_arcs.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

// The area between the arcs, from J / w^2.
double area(const TensorPreimage& p) {
  const auto j = orientation(p);
  const std::vector<double> c(j.coefficients.begin(), j.coefficients.end());
  const Net net = sphere_image(p);
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  return Gauss::integrate(
      [&](double u) {
        return Gauss::integrate(
            [&](double v) {
              const double w = net_first(net, u, v).value.w;
              return tensor_value(c.data(), j.m, j.n, u, v) / (w * w);
            },
            0.0, 1.0);
      },
      0.0, 1.0);
}

}  // namespace

TEST_CASE("the holonomy is the excess of the interior angles", "[projective]") {
  NetMaker make(41);
  WorstCase worst;
  for (int k = 0; k < 300; ++k) {
    const SphericalQuad quad = bulging(make, 0.4);
    long double sum = 0;
    for (const long double a : shape_of(quad, quad.corner(0) + quad.corner(2)).angle) sum += a;
    const long double excess = std::remainder((sum - 360) * pi / 360 - std::arg(holonomy(quad)), 2 * pi);
    worst.add(static_cast<double>(std::abs(excess)), 1e-15, [&] { return fmt::format("quad {}", k); });
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("bilinear nets bound quadrilaterals of holonomy 1 (theorem 3.9)", "[projective]") {
  NetMaker make(42);
  WorstCase worst;
  int positive = 0, negative = 0, rounds = 60;
  for (int k = 0; k < rounds; ++k) {
    const TensorPreimage p = random_bilinear(make);
    const SphericalQuad quad = quad_of(p);
    const auto text = [&] { return fmt::format("net {}", k); };
    worst.add(static_cast<double>(std::abs(holonomy(quad) - 1.0L)), 1e-13, text);
    // Corners 0 and 2 lie on a circle with the second meeting points of the arcs at 1 and 3: those are the
    // corner reflected in the plane of the centre and the line that joins the planes of both arcs.
    const auto second = [&](std::size_t corner) {
      const SphereArc& in = quad.arc[(corner + 3) % 4];
      const SphereArc& out = quad.arc[corner];
      const lvec3 line = glm::normalize(glm::cross(in_plane(in), in_plane(out)));
      return out.p - 2 * glm::dot(out.p, line) * line;
    };
    const lvec3 p0 = quad.corner(0), p2 = quad.corner(2), q1 = second(1), q3 = second(3);
    // Conditioned by how flat the planes meet.
    const double volume = static_cast<double>(glm::dot(glm::cross(p2 - p0, q1 - p0), q3 - p0));
    worst.add(std::abs(volume), 1e-12, text);
    // With either arc of each circle: half of the 16 choices close, the others miss by the sign.
    for (unsigned choice = 0; choice < 16; ++choice) {
      SphericalQuad other = quad;
      for (std::size_t a = 0; a < 4; ++a) {
        SphereArc& arc = other.arc[a];
        if ((choice >> a & 1U) != 0) arc = {arc.p, arc.q, -arc.b, -arc.w};
      }
      const Complex h = holonomy(other);
      positive += std::abs(h - 1.0L) < 1e-12L;
      negative += std::abs(h + 1.0L) < 1e-12L;
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(positive == 8 * rounds);
  CHECK(negative == 8 * rounds);
}

TEST_CASE("the planes of theorem 3.9's proof make the same patch", "[projective]") {
  NetMaker make(46);
  WorstCase worst;
  int closed = 0, open = 0;
  for (int k = 0; k < 400; ++k) {
    SphericalQuad quad = quad_of(k % 2 == 0 ? random_bilinear(make) : square_bilinear(make));
    // The other arc of two circles closes as well, that of one circle does not.
    for (std::size_t a = 0; a < static_cast<std::size_t>(k % 3); ++a) {
      SphereArc& arc = quad.arc[a];
      arc = {arc.p, arc.q, -arc.b, -arc.w};
    }
    const std::optional<TensorPreimage> planes = bilinear_preimage_by_planes(quad);
    (planes ? closed : open) += 1;
    CHECK(planes.has_value() == (k % 3 != 1));
    if (!planes) continue;
    // Up to the moduli of the control points, and one phase of all.
    const TensorPreimage phases = bilinear_preimage(quad, 1);
    Complex first = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const Spinor p = to_spinor(planes->coefficients[c]), q = to_spinor(phases.coefficients[c]);
      Complex ratio = std::abs(q.a) > std::abs(q.b) ? p.a / q.a : p.b / q.b;
      ratio /= std::abs(ratio);
      if (c == 0) first = ratio;
      // Rounding of the arcs, over the sines of the angles between planes and lines.
      worst.add(static_cast<double>(std::abs(ratio - first)), 1e-12,
                [&] { return fmt::format("quad {}", k); });
    }
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(closed > 250);
  CHECK(open > 100);
  // Arcs that do not close at all.
  CHECK_FALSE(bilinear_preimage_by_planes(convex_geodesic(make)));
}

TEST_CASE("biquadratic patches have the sides they should", "[projective]") {
  NetMaker make(43);
  WorstCase worst;
  int regular = 0, sums = 0;
  for (int k = 0; k < 400; ++k) {
    const SphericalQuad quad = quad_of(k % 2 == 0 ? random_bilinear(make) : square_bilinear(make));
    const TensorPreimage p = bilinear_preimage(quad, make.uniform(0.2, 5));
    const Net net = sphere_image(p);
    const auto text = [&] { return fmt::format("quad {}", k); };
    worst.add(off_circles(std::get<TensorNet>(net), quad), 1e-13, text);
    worst.add(off_corners(net, quad), 1e-13, text);
    if (!regularity(p).regular) continue;
    // Corollary 3.12.
    ++regular;
    long double sum = 0, largest = 0;
    for (const long double a : shape_of(quad, quad.corner(0) + quad.corner(2)).angle) {
      sum += a;
      largest = std::max(largest, a);
    }
    if (largest > 180) continue;
    worst.add(static_cast<double>(std::abs(sum - 360)), 1e-10, text);
    ++sums;
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(sums > 20);
  CHECK(sums == regular);
}

TEST_CASE("the shape moves parameters only", "[projective]") {
  NetMaker make(44);
  WorstCase worst;
  for (int k = 0; k < 50; ++k) {
    const SphericalQuad quad = quad_of(random_bilinear(make));
    const long double shape = make.uniform(0.2, 5);
    const TensorPreimage p = bilinear_preimage(quad, shape);
    const long double ratio = glm::length(p.at(0, 0)) * glm::length(p.at(1, 1)) /
                              (glm::length(p.at(1, 0)) * glm::length(p.at(0, 1)));
    worst.add(static_cast<double>(std::abs(ratio / shape - 1)), 1e-17,
              [&] { return fmt::format("quad {}", k); });
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("every quadrilateral of arcs has patches of degree (2, 4) (theorem 3.10)", "[projective]") {
  NetMaker make(45);
  WorstCase worst, areas;
  int folded = 0, in_both = 0;
  for (int k = 0; k < 300; ++k) {
    const bool geodesic = k % 2 == 0;
    const SphericalQuad quad = geodesic ? convex_geodesic(make) : bulging(make, 0.3);
    const TensorPreimage choices[] = {linear_quadratic_preimage(quad), quadratic_linear_preimage(quad)};
    int good = 0;
    for (const TensorPreimage& p : choices) {
      const Net net = sphere_image(p);
      const auto text = [&] { return fmt::format("quad {}, {} x {}", k, p.m, p.n); };
      const auto& tensor = std::get<TensorNet>(net);
      CHECK((tensor.m == 2 * p.m && tensor.n == 2 * p.n && p.m + p.n == 3));
      worst.add(off_circles(tensor, quad), 1e-14, text);
      worst.add(off_corners(net, quad), 1e-14, text);
      CHECK(base_points(p, false, 1).empty());
      const bool regular = regularity(p).regular;
      good += regular;
      folded += geodesic && !regular;
      // Girard: the area between great circles is the excess of the angles, twice the holonomy's argument.
      if (geodesic)
        areas.add(std::abs(area(p) - 2 * static_cast<double>(std::arg(holonomy(quad)))), 1e-8, text);
    }
    in_both += good == 0;
  }
  INFO(worst.text());
  INFO(areas.text());
  CHECK(worst.failures() == 0);
  CHECK(areas.failures() == 0);
  CHECK(folded == 0);
  CHECK(in_both <= 1);
}

TEST_CASE("triangles of arcs", "[projective]") {
  NetMaker make(46);
  WorstCase worst;
  int folded = 0, closing = 0, regular_linear = 0;
  for (int k = 0; k < 200; ++k) {
    const auto text = [&] { return fmt::format("triangle {}", k); };
    // Plane nets, whose circles have a point in common: holonomy 1 (section 3.5).
    TrianglePreimage plane(1);
    for (lvec4& c : plane.coefficients) c = make.point(-1.0, 1.0);
    const lvec4 &a = plane.at(1, 0), &b = plane.at(0, 1), &c = plane.at(0, 0);
    const SphericalTriangle with_common_point{{arc_of(a, b), arc_of(b, c), arc_of(c, a)}};
    closing += std::abs(holonomy(with_common_point) - 1.0L) < 1e-13L;
    const Net quadratic = sphere_image(linear_preimage(with_common_point));
    worst.add(off_circles(std::get<TriangleNet>(quadratic), with_common_point), 1e-13, text);
    regular_linear += regularity(linear_preimage(with_common_point)).regular;
    // Great circles, counter-clockwise, and arcs that bulge.
    std::array<lvec3, 3> corner{direction(make), direction(make), direction(make)};
    if (glm::dot(corner[0], glm::cross(corner[1], corner[2])) < 0) std::swap(corner[0], corner[1]);
    SphericalTriangle triangle;
    for (std::size_t s = 0; s < 3; ++s) {
      const lvec3 p = corner[s], q = corner[(s + 1) % 3];
      // Great circles when k is even, otherwise a little outward.
      const lvec3 middle =
          glm::normalize(p + q) + static_cast<long double>(make.uniform(0, 0.3) * (k % 2)) * glm::cross(q, p);
      triangle.arc[s] = arc_through(p, glm::normalize(middle), q);
    }
    const TrianglePreimage p = quadratic_preimage(triangle);
    CHECK(base_points(p, false, 1).empty());
    const Net quartic = sphere_image(p);
    CHECK(std::get<TriangleNet>(quartic).n == 4);
    worst.add(off_circles(std::get<TriangleNet>(quartic), triangle), 1e-13, text);
    folded += k % 2 == 0 && !regularity(p).regular;
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(closing == 200);
  CHECK(regular_linear > 20);
  CHECK(folded == 0);
}

TEST_CASE("a biquadratic patch is two quadratic triangles (corollary 3.11)", "[projective]") {
  NetMaker make(47);
  WorstCase worst;
  for (int k = 0; k < 100; ++k) {
    // Cut along the diagonal of the bilinear net that joins (1, 0) and (0, 1).
    const TensorPreimage p = random_bilinear(make);
    const SphericalQuad quad = quad_of(p);
    const SphereArc diagonal = arc_of(p.at(1, 0), p.at(0, 1)), back = arc_of(p.at(0, 1), p.at(1, 0));
    const SphericalTriangle low{{quad.arc[0], diagonal, quad.arc[3]}};
    const SphericalTriangle high{{quad.arc[1], quad.arc[2], back}};
    const Complex product = holonomy(low) * holonomy(high);
    const auto text = [&] { return fmt::format("net {}", k); };
    worst.add(static_cast<double>(std::abs(product - holonomy(quad))), 1e-13, text);
    for (const SphericalTriangle& t : {low, high}) {
      worst.add(static_cast<double>(std::abs(holonomy(t) - 1.0L)), 1e-13, text);
      const Net net = sphere_image(linear_preimage(t));
      worst.add(off_circles(std::get<TriangleNet>(net), t), 1e-13, text);
    }
    // An arc of another circle as diagonal spoils both alike.
    const lvec3 aside = glm::normalize(image(p.at(1, 0) + p.at(0, 1)) + 0.2L * direction(make));
    const SphereArc bent = arc_through(diagonal.p, aside, diagonal.q);
    const SphericalTriangle half{{quad.arc[0], bent, quad.arc[3]}};
    const SphericalTriangle rest{{quad.arc[1], quad.arc[2], arc_through(bent.q, aside, bent.p)}};
    worst.add(static_cast<double>(std::abs(holonomy(half) * holonomy(rest) - 1.0L)), 1e-13, text);
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

}  // namespace rondure
