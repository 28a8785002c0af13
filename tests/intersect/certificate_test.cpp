// Certificates: right where the oracle can tell. That no pixel of a shipped scene is without one is tested
// where the film's layer is.

#include "renderer/intersect/certificate.h"

#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <random>

#include "renderer/bezier/quotient.h"
#include "renderer/bezier/rational.h"
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
  long certified = 0, refused = 0, unknown = 0, contradicted = 0, alone = 0, crowded = 0;
  std::string worst = "none";
  WorstCase t, point, radius;
  const std::vector<ClosedModel>& models = closed_models();
  for (std::size_t m = 0; m < models.size(); ++m) {
    const ClosedModel& model = models[m];
    const Tracer tracers[] = {Tracer({{model.surface, Solver::newton}}),
                              Tracer({{model.surface, Solver::clipping}}),
                              Tracer({{model.surface, Solver::quadric}})};
    const Certifier certifiers[] = {Certifier(tracers[0]), Certifier(tracers[1]), Certifier(tracers[2])};
    const long rays = static_cast<long>(soaked(12, 3000));
    for (long k = 0; k < rays; ++k) {
      const auto which = static_cast<RayClass>(k % static_cast<long>(RayClass::count));
      if (which == RayClass::from_surface) continue;
      const Ray ray = aim(model, which, random).ray;
      const std::size_t solver = (m + static_cast<std::size_t>(k)) % std::size(tracers);
      const Hit hit = tracers[solver].closest(ray);
      const Certificate c = certifiers[solver].certify(ray, hit);
      ++(c ? certified : refused);
      if (!c) continue;
      const oracle::Meeting truth = oracle::meet(model.surface, ray);
      unknown += truth.exhausted;
      if (truth.exhausted) continue;
      const std::vector<oracle::Root>& roots = truth.roots;
      double first = INFINITY;
      for (const oracle::Root& root : roots)
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
      // Its point too, and the hit's in the frame: half an ulp of three coordinates each.
      double off = INFINITY;
      long near = 0;
      for (const oracle::Root& root : roots) {
        if (root.patch != hit.patch) continue;
        near += std::max(std::fabs(root.u - hit.u), std::fabs(root.v - hit.v)) < c.isolation;
        off = std::fmin(off, glm::length(hit.point - model.surface.origin - root.point));
      }
      alone += c.exists && c.unique;
      crowded += c.unique && near > 1;  // where parameters are ill-conditioned the root itself may be further
      point.add(off, c.point_error + 0x1p-51 * model.radius, describe);
    }
  }
  WARN(certified << " certified, " << refused << " not; t: " << t.text() << "\npoint: " << point.text());
  INFO("contradicted: " << worst);
  INFO("t: " << t.text());
  INFO("point: " << point.text());
  INFO("radius: " << radius.text());
  CHECK(contradicted == 0);
  CHECK(crowded == 0);
  CHECK(t.failures() == 0);
  CHECK(point.failures() == 0);
  // Rays are aimed where no proof can be had, or none that is narrow: within rounding of tangency and at
  // singular points.
  CHECK(refused < certified / 5);
  CHECK(radius.failures() < radius.count() / 10);
  CHECK(t.count() > certified / 3);
  CHECK(alone > t.count() / 2);
  CHECK(unknown < certified / 50);
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

TEST_CASE("Beside a rim no hit is certified, and inside of it no miss", "[certificate]") {
  // Sides u = 0 that nothing continues: rays along the normal, beside and inside.
  Surface bowl, tile = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  TensorNet net(2, 2);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) net.at(i, j) = dvec4(i - 1, j - 1, i == 1 && j == 1 ? 0.5 : 0.0, 1.0);
  bowl.patches = {net};
  Surface leaf = build_family(R"({"type": "sphere_octant"})");
  for (Surface* one : {&tile, &leaf}) one->patches.resize(1), one->joins.clear(), one->closed = false;
  const std::vector<TracedSurface> traced = {
      {bowl, Solver::newton},  {bowl, Solver::clipping}, {tile, Solver::newton},  {tile, Solver::clipping},
      {tile, Solver::quadric}, {leaf, Solver::newton},   {leaf, Solver::quadric},
  };
  long beside = 0, hits_beside = 0, misses_proven = 0, inside = 0, misses_inside = 0, at = 0, refused = 0;
  std::string worst = "none";
  for (std::size_t k = 0; k < traced.size(); ++k) {
    const Surface& surface = traced[k].surface;
    const Tracer tracer({traced[k]});
    const Certifier certifier(tracer);
    for (const double v : {0.13, 0.25, 0.55, 0.8}) {
      const FirstOrder<dvec4> s = net_first(surface.patches[0], 0.0, v);
      const dvec3 p = dvec3(s.value) / s.value.w, du = dvec3(s.du) - s.du.w * p,
                  dv = glm::normalize(dvec3(s.dv) - s.dv.w * p);
      const dvec3 out = -glm::normalize(du - glm::dot(du, dv) * dv), normal = glm::cross(out, dv);
      const auto ray_at = [&](double delta) { return Ray{p + delta * out + 2.0 * normal, -normal}; };
      const auto note = [&](double delta, bool wrong) {
        if (wrong) worst = fmt::format("surface {}, v = {}, {:g} outside", k, v, delta);
        return wrong;
      };
      Hit rim;
      rim.t = 2.0, rim.surface = rim.patch = 0, rim.v = v, rim.point = p, rim.normal = normal;
      // Rounding is 23 roundoffs of the patch and the ray's base, together below 3, and 1.5e-15 for the
      // parameters: 1e-14. On a sphere it is 131, 5e-14. What the rim bends away within delta is less.
      const double least = traced[k].solver == Solver::quadric ? 1e-13 : 2e-14;
      for (double delta = least; delta < 0.07; delta *= 3.0) {
        ++beside, ++inside;
        hits_beside += note(delta, static_cast<bool>(certifier.certify(ray_at(delta), rim)));
        misses_proven += static_cast<bool>(certifier.certify(ray_at(delta), {}));
        misses_inside += note(-delta, static_cast<bool>(certifier.certify(ray_at(-delta), {})));
      }
      // Where rounding decides it does so for a hit that is on the patch's side.
      for (const double delta : {0.0, 1e-16, -1e-16, 4e-16, -4e-16}) {
        const Hit hit = tracer.closest(ray_at(delta));
        at += static_cast<bool>(hit);
        refused += hit && note(delta, !certifier.certify(ray_at(delta), hit));
      }
    }
  }
  INFO("the last that is wrong: " << worst);
  INFO(misses_proven << " of " << beside << " misses proven, " << at << " hits on a rim");
  CHECK(hits_beside == 0);
  CHECK(misses_inside == 0);
  CHECK(refused == 0);
  CHECK(100 * misses_proven > 95 * beside);
  CHECK(inside > 500);
  CHECK(at > 20);
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
