// Spinors, and the arcs that they make.
#include "renderer/projective/spinor.h"

#include <fmt/format.h>

#include "renderer/projective/sphere_arc.h"
#include "tests/catch.h"
#include "tests/projective/integer_points.h"
#include "tests/projective/random_arcs.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

lvec3 point(const lvec4& x) { return lvec3(x) / x.w; }

constexpr long double long_roundoff = 0x1p-63L;

}  // namespace

TEST_CASE("spinors say what the paper's products say", "[projective]") {
  IntegerPoints make(11);
  int wrong = 0;
  for (int k = 0; k < 200; ++k) {
    const lvec4 p = make.point(), r = make.point();
    const Complex d = det(to_spinor(r), to_spinor(p));
    wrong += to_point(to_spinor(p)) != p;
    wrong += to_point(Complex(0, -1) * to_spinor(p)) != perp(p);
    wrong += d.imag() != glm::dot(bar(r), p);
    wrong += d.real() != glm::dot(perp(bar(r)), p);
    wrong += -d.real() != glm::dot(bar(r), perp(p));
    wrong += norm(to_spinor(p)) != delta(p).w;
    // 2 a conj(b) = x + i y.
    const Complex ab = to_spinor(p).a * std::conj(to_spinor(p).b);
    wrong += 2 * ab.real() != delta(p).x || 2 * ab.imag() != delta(p).y;
  }
  CHECK(wrong == 0);
}

TEST_CASE("every point of the sphere has a spinor", "[projective]") {
  NetMaker make(12);
  WorstCase worst;
  const auto check = [&](const lvec3& x) {
    const lvec4 found = delta(spinor_at(x));
    const auto text = [&] { return fmt::format("({}, {}, {})", double(x.x), double(x.y), double(x.z)); };
    // x and y, which small ones keep all their digits: a few roundings of the square root and products.
    const long double size = std::hypot(x.x, x.y);
    worst.add(double(std::hypot(found.x - x.x, found.y - x.y)), double(8 * long_roundoff * size) + 1e-300,
              text);
    worst.add(double(std::abs(found.z - x.z)), double(8 * long_roundoff), text);
    worst.add(double(std::abs(found.w - 1)), double(8 * long_roundoff), text);
  };
  for (int k = 0; k < 300; ++k) check(direction(make));
  for (const long double s : {1e-5L, 1e-12L, 1e-200L, 0.0L}) {
    for (const long double z : {1.0L, -1.0L}) check(glm::normalize(lvec3(s, -2 * s, z)));
  }
  check({1, 0, 0});
  INFO(worst.text());
  CHECK(worst.failures() == 0);
}

TEST_CASE("arcs pass through the point they should", "[projective]") {
  NetMaker make(13);
  WorstCase worst;
  int outside = 0, inside = 0;
  for (int k = 0; k < 300; ++k) {
    const lvec3 p = direction(make), r = direction(make), q = direction(make);
    const auto text = [&] { return fmt::format("arc {}", k); };
    const Spinor sp = spinor_at(p), sq = arc_phase(sp, spinor_at(r), spinor_at(q)) * spinor_at(q);
    // The symmetric conic that was found without spinors.
    const SphereArc expected = arc_through(p, r, q);
    const lvec4 middle = delta(to_point(sp), to_point(sq));
    // Conditioned by the nearness of r to the ends.
    const double scale = double(1 / (glm::length(p - r) * glm::length(q - r)));
    worst.add(double(glm::length(middle - lvec4(expected.b, expected.w))), 32 * double(long_roundoff) * scale,
              text);
    worst.add(double(glm::length(delta(sp) - lvec4(p, 1))), 8 * double(long_roundoff), text);
    worst.add(double(glm::length(delta(sq) - lvec4(q, 1))), 16 * double(long_roundoff), text);
    // And r divides the segment in the ratio |d_rp| : |d_rq|, by lemma 3.7.
    const long double a = std::abs(det(spinor_at(r), sp)), b = std::abs(det(spinor_at(r), sq));
    const lvec4 at = (b * to_point(sp) + a * to_point(sq)) / (a + b);
    worst.add(double(glm::length(point(delta(at)) - r)), 64 * double(long_roundoff) * scale, text);
    // With the printed sign the segment runs the other way round.
    const lvec4 other = (b * to_point(sp) - a * to_point(sq)) / (a + b);
    outside += glm::length(point(delta(other)) - r) > 1e-6L;
    ++inside;
  }
  INFO(worst.text());
  CHECK(worst.failures() == 0);
  CHECK(outside == inside);
}

}  // namespace rondure
