// Arcs on the sphere and their plane images against Cobb's route: complex numbers in the plane.
#include "renderer/projective/sphere_arc.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>

#include "renderer/projective/frame.h"
#include "tests/bezier/random_nets.h"
#include "tests/catch.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

constexpr double extended_eps = 0x1p-63;

lvec3 random_point(NetMaker& make) {
  for (;;) {
    const double x = make.uniform(-1.0, 1.0), y = make.uniform(-1.0, 1.0), z = make.uniform(-1.0, 1.0);
    const lvec3 p(x, y, z);
    if (glm::dot(p, p) < 1 && glm::dot(p, p) > 0.01L) return glm::normalize(p);
  }
}

// Homogeneous point of the arc.
std::pair<lvec3, long double> at(const SphereArc& arc, long double t) {
  const long double a = (1 - t) * (1 - t), b = 2 * t * (1 - t), c = t * t;
  return {a * arc.p + b * arc.b + c * arc.q, a + b * arc.w + c};
}

}  // namespace

TEST_CASE("arcs lie on the sphere and in the plane of their three points", "[projective]") {
  NetMaker make(3);
  WorstCase sphere, plane;
  int longer = 0;
  for (int k = 0; k < 2000; ++k) {
    const lvec3 p = random_point(make), q = random_point(make), r = random_point(make);
    if (glm::length(p - q) < 0.1L || glm::length(p - r) < 0.1L || glm::length(q - r) < 0.1L) continue;
    const SphereArc arc = arc_through(p, r, q);
    const lvec3 normal = glm::cross(r - p, q - r);
    if (arc.w < 0) ++longer;
    // The arc turns counter-clockwise about the normal, from p past r to q.
    long double last = -1;
    for (const long double t : {0.0L, 0.2L, 0.5L, 0.9L, 1.0L}) {
      const auto [x, w] = at(arc, t);
      const auto describe = [&] { return fmt::format("case {}, t = {}", k, static_cast<double>(t)); };
      // w sinks to half of 1 + arc.w in the middle of a long arc, and rounding is relative to 1.
      const double scale = static_cast<double>(1 / w + 1);
      sphere.add(static_cast<double>(std::abs(glm::dot(x, x) / (w * w) - 1)), 40 * extended_eps * scale,
                 describe);
      plane.add(static_cast<double>(std::abs(glm::dot(normal, x / w - p)) / glm::length(normal)),
                400 * extended_eps * scale, describe);
      const lvec3 middle = normal * (glm::dot(normal, p) / glm::dot(normal, normal));
      const lvec3 e0 = glm::normalize(p - middle), e1 = glm::normalize(glm::cross(normal, e0));
      long double angle = std::atan2(glm::dot(x / w - middle, e1), glm::dot(x / w - middle, e0));
      if (angle < -1e-9L) angle += 2 * 3.14159265358979323846L;
      if (!(angle > last)) FAIL("the arc turns back in case " << k);
      last = angle;
    }
  }
  INFO(sphere.text());
  INFO(plane.text());
  CHECK(sphere.count() > 5000);
  CHECK(longer > 200);
  CHECK(sphere.failures() == 0);
  CHECK(plane.failures() == 0);
}

TEST_CASE("great arcs and arcs in planes are arcs through their middle", "[projective]") {
  NetMaker make(4);
  WorstCase worst;
  for (int k = 0; k < 500; ++k) {
    const lvec3 p = random_point(make), q = random_point(make), r = random_point(make);
    if (glm::length(p - q) < 0.1L || glm::length(p + q) < 0.1L) continue;
    const SphereArc great = great_arc(p, q), same = arc_through(p, glm::normalize(p + q), q);
    const double off = static_cast<double>(glm::length(great.b - same.b) + std::abs(great.w - same.w));
    // Two divisions by distances of at least 0.05.
    worst.add(off, 1000 * extended_eps, [&] { return fmt::format("great arc {}", k); });
    // A plane through both, by any third point; the shorter arc has a positive weight.
    const lvec3 normal = glm::normalize(glm::cross(q - p, r - p));
    const long double distance = glm::dot(normal, p);
    if (distance * distance > 0.9L || glm::length(p + q - 2 * distance * normal) < 0.1L) continue;
    const lvec3 middle = middle_in_plane(p, q, normal, distance);
    const SphereArc arc = arc_through(p, middle, q);
    if (!(arc.w > 0)) FAIL("the longer arc in case " << k);
    worst.add(static_cast<double>(std::abs(glm::length(middle - p) - glm::length(middle - q)) +
                                  std::abs(glm::dot(normal, middle) - distance)),
              1000 * extended_eps, [&] { return fmt::format("plane {}", k); });
  }
  INFO(worst.text());
  CHECK(worst.count() > 600);
  CHECK(worst.failures() == 0);
}

TEST_CASE("plane images have the control points of planar arcs", "[projective]") {
  NetMaker make(5);
  WorstCase worst;
  for (int k = 0; k < 1000; ++k) {
    const lvec3 p = random_point(make), q = random_point(make), m = random_point(make);
    const StereographicFrame frame(random_point(make));
    const lvec3 hp = frame.project(p, 1), hq = frame.project(q, 1), hm = frame.project(m, 1);
    if (hp.z < 0.1L || hq.z < 0.1L || hm.z < 0.1L) continue;
    if (glm::length(p - q) < 0.1L || glm::length(p - m) < 0.1L || glm::length(q - m) < 0.1L) continue;
    const Complex zp(hp.x / hp.z, hp.y / hp.z), zq(hq.x / hq.z, hq.y / hq.z), zm(hm.x / hm.z, hm.y / hm.z);
    // The middle control point of the arc from zp to zq through zm, with end weights hp.z and hq.z.
    const Complex e0 = std::conj(zm - zp) / std::abs(zm - zp), e1 = -std::conj(zm - zq) / std::abs(zm - zq);
    const Complex turn = e0 * std::conj(e1);
    const long double g = std::sqrt(hp.z * hq.z);
    const Complex z1 = g * (zp * turn + zq * std::conj(turn)) / 2.0L;
    const long double w1 = g * turn.real();
    const SphereArc arc = arc_through(p, m, q);
    const lvec3 image = frame.project(arc.b, arc.w);
    const double off = static_cast<double>(glm::length(image - lvec3(z1.real(), z1.imag(), w1)));
    // Planar coordinates reach 2 * sqrt(1.9 / 0.1), distances sink to about 0.1 / 2: some hundred roundings.
    worst.add(off, 2000 * extended_eps, [&] { return fmt::format("case {}", k); });
  }
  INFO(worst.text());
  CHECK(worst.count() > 400);
  CHECK(worst.failures() == 0);
}

}  // namespace rondure
