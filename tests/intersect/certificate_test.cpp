// Certificates: right where the oracle can tell. That no pixel of a shipped scene is without one is tested
// where the film's layer is.

#include "renderer/intersect/certificate.h"

#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <random>

#include "renderer/bezier/quotient.h"
#include "tests/catch.h"
#include "tests/intersect/placed.h"
#include "tests/intersect/random_direction.h"
#include "tests/intersect/ray_classes.h"
#include "tests/oracle/oracle.h"
#include "tests/soak.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

std::string text_of(const Ray& ray) {
  return fmt::format("o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g})", ray.origin.x,
                     ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z);
}

}  // namespace

TEST_CASE("A certificate says what the oracle finds", "[certificate]") {
  std::mt19937_64 random(7);
  long certified = 0, refused = 0, contradicted = 0;
  std::string worst = "none";
  WorstCase t, radius;
  for (const ClosedModel& model : closed_models()) {
    const Tracer tracer({{model.surface, Solver::newton}});
    const Certifier certifier(tracer);
    const long rays = static_cast<long>(soaked(11, 3000));
    for (long k = 0; k < rays; ++k) {
      const auto which = static_cast<RayClass>(k % static_cast<long>(RayClass::count));
      if (which == RayClass::from_surface) continue;
      const Ray ray = aim(model, which, random).ray;
      const Hit hit = tracer.closest(ray);
      const Certificate c = certifier.certify(ray, hit);
      ++(c ? certified : refused);
      if (!c) continue;
      double first = INFINITY;
      for (const oracle::Root& root : oracle::meet(model.surface, ray).roots)
        if (root.t >= 0.0 && root.outside <= 0x1p-50) first = std::min(first, root.t);
      const auto describe = [&] { return model.name + ": " + text_of(ray); };
      if (static_cast<bool>(hit) != (first < INFINITY) && c.means != Means::boundary) {
        ++contradicted, worst = describe();
        continue;
      }
      if (!hit || !(first < INFINITY)) continue;
      // The oracle's t is a double: half an ulp of it.
      t.add(std::fabs(hit.t - first), c.t_error + 0x1p-53 * first, describe);
      radius.add(c.t_error, 1e-9 * (std::fabs(hit.t) + quotient(model.radius, glm::length(ray.direction))),
                 describe);
    }
  }
  WARN(certified << " certified, " << refused << " not");
  INFO("contradicted: " << worst);
  INFO("t: " << t.text());
  INFO("radius: " << radius.text());
  CHECK(contradicted == 0);
  CHECK(t.failures() == 0);
  // Rays are aimed where no proof can be had: within rounding of tangency and at singular points.
  CHECK(refused < certified / 5);
  CHECK(t.count() > certified / 3);
}

TEST_CASE("A hit on an analytic sphere does not stand in its own way", "[certificate]") {
  // Small and far away the root's bounds, in directions from the point nearest to the centre, are closer than
  // t rounds.
  std::mt19937_64 random(11);
  long hits = 0, refused = 0;
  std::string worst = "none";
  for (const double radius : {0.02, 0.05, 1.0}) {
    const dvec3 center(0.6, -0.4, 0.9);
    const Tracer tracer({{placed(build_family(R"({"type": "sphere"})"), radius, center), Solver::newton}});
    const Certifier certifier(tracer);
    for (int k = 0; k < 100'000; ++k) {
      const dvec3 origin = center + 9.0 * random_direction(random);
      const Ray ray{origin, glm::normalize(center + 0.9 * radius * random_direction(random) - origin)};
      const Hit hit = tracer.closest(ray);
      const Certificate c = certifier.certify(ray, hit);
      hits += static_cast<bool>(hit);
      if (!c) ++refused, worst = text_of(ray);
    }
  }
  INFO(hits << " hits, " << refused << " not certified: " << worst);
  CHECK(refused == 0);
  CHECK(hits == 300'000);
}

TEST_CASE("What is not so is not certified", "[certificate]") {
  const Tracer tracer(
      {{build_family(R"({"type": "sphere_tiling", "topology": "cube"})"), Solver::newton},
       {placed(build_family(R"({"type": "sphere"})"), 0.5, dvec3(0.1, 0.0, 2.5)), Solver::newton}});
  const Certifier certifier(tracer);
  std::mt19937_64 random(3);
  long proven = 0, misled = 0, rays = 0;
  for (int k = 0; k < 200; ++k) {
    const dvec3 origin = 4.0 * random_direction(random), target = 0.9 * random_direction(random);
    const Ray ray{origin, target - origin};
    const std::vector<Hit> hits = tracer.all(ray);
    if (hits.size() < 2 || glm::dot(hits[0].normal, ray.direction) > -0.1) continue;
    ++rays;
    const Certificate good = certifier.certify(ray, hits[0]);
    proven +=
        good && good.exists && good.unique && good.first && good.t_error < 1e-10 && good.point_error < 1e-10;
    // A later wall, no wall, a wall beside the ray, and the wall before a start past it.
    misled += static_cast<bool>(certifier.certify(ray, hits[1]));
    misled += static_cast<bool>(certifier.certify(ray, {}));
    if (hits[0].surface == 0) {
      Hit beside = hits[0];
      beside.u = beside.u < 0.5 ? beside.u + 0.1 : beside.u - 0.1;
      const Certificate c = certifier.certify(ray, beside);
      misled += c && c.point_error < 1e-3;
    }
    Hit moved = hits[0];
    moved.t += 1e-9;
    misled += certifier.certify(ray, moved).t_error < 0.99e-9;
  }
  INFO(rays << " rays, " << proven << " proven, " << misled << " proofs of what is wrong");
  CHECK(misled == 0);
  CHECK(proven == rays);
  CHECK(rays > 50);
}

TEST_CASE("No miss is certified before a root just short of the ray's end", "[certificate]") {
  const Surface surface = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  const Tracer tracer({{surface, Solver::newton}});
  const Certifier certifier(tracer);
  std::mt19937_64 random(11);
  long ended = 0, missed = 0, misled = 0, proven = 0;
  for (int k = 0; k < 400; ++k) {
    Ray ray{3.0 * random_direction(random), {}};
    ray.direction = 0.6 * random_direction(random) - ray.origin;
    const Hit hit = tracer.closest(ray);
    if (!hit) continue;
    // An ulp before what the solver says: half of the roots are there, as rounding has it.
    ray.t_max = std::nextafter(hit.t, 0.0);
    ++ended;
    double first = INFINITY;
    for (const oracle::Root& root : oracle::meet(surface, ray).roots)
      if (root.t >= 0.0 && root.outside <= 0.0) first = std::min(first, root.t);
    // The oracle's t is rounded; where that is below t_max, so is the root.
    const Hit none = tracer.closest(ray);
    missed += !none && first < ray.t_max;
    misled += !none && first < ray.t_max && certifier.certify(ray, none);
    ray.t_max = (1.0 - 1e-9) * hit.t;
    proven += static_cast<bool>(certifier.certify(ray, tracer.closest(ray)));
  }
  INFO(ended << " rays ended, " << missed << " a root too early, " << misled << " of these certified; "
             << proven << " proven that end well before");
  CHECK(misled == 0);
  CHECK(missed > 0);
  CHECK(proven == ended);
}

TEST_CASE("No miss is certified of a ray from too far away to be followed", "[certificate]") {
  for (const char* type : {R"({"type": "sphere_tiling", "topology": "cube"})", R"({"type": "sphere"})"}) {
    const Tracer tracer({{build_family(type), Solver::newton}});
    const Ray towards{dvec3(1e300, 0.0, 0.0), dvec3(-1.0, 0.0, 0.0)};
    const Hit hit = tracer.closest(towards);
    CHECK((hit || !Certifier(tracer).certify(towards, hit)));
  }
}

}  // namespace rondure
