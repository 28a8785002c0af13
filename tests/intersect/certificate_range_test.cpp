// Certificates whatever the length of a direction and the unit of length: a power of two changes no bit of a
// surface or a ray, and should change none of what is proven of them.

#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "renderer/intersect/certificate.h"
#include "tests/catch.h"
#include "tests/intersect/closed_models.h"
#include "tests/intersect/placed.h"
#include "tests/intersect/random_direction.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

std::vector<ClosedModel> models_and_sphere() {
  std::vector<ClosedModel> out = closed_models();
  ClosedModel sphere;
  sphere.name = "analytic sphere", sphere.surface = build_family(R"({"type": "sphere"})");
  out.push_back(sphere);
  return out;
}

// Components of few bits, so that they are denormal numbers too.
dvec3 short_direction_to(const dvec3& way, std::mt19937_64& random) {
  const dvec3 aimed = way + 0.3 * random_direction(random);
  return glm::round(128.0 * glm::normalize(aimed));
}

dvec3 scaled(const dvec3& x, int exponent) {
  return {std::ldexp(x.x, exponent), std::ldexp(x.y, exponent), std::ldexp(x.z, exponent)};
}

}  // namespace

TEST_CASE("Certificates bound the errors of t and of the point for directions of any length",
          "[certificate]") {
  std::mt19937_64 random(5);
  long hits = 0, misses = 0, unresolved = 0, beyond = 0, not_so = 0;
  std::string worst = "none";
  WorstCase t, t_bound, point_bound;
  for (const ClosedModel& model : models_and_sphere()) {
    const Tracer tracer({{model.surface, Solver::newton}});
    const Certifier certifier(tracer);
    for (int k = 0; k < 4; ++k) {
      const dvec3 way = random_direction(random);
      const dvec3 from = model.surface.origin - 2.0 * model.radius * way, d = short_direction_to(way, random);
      const Hit hit = tracer.closest({from, d});
      const Certificate c = certifier.certify({from, d}, hit);
      if (!c) continue;
      for (const int exponent :
           {-1074, -1070, -1050, -1022, -1000, -901, -899, -540, -500, 500, 540, 900, 1000, 1016}) {
        const Ray ray{from, scaled(d, exponent)};
        const Hit there = tracer.closest(ray);
        const Certificate q = certifier.certify(ray, there);
        const auto describe = [&] { return fmt::format("{}, ray {}, times 2^{}", model.name, k, exponent); };
        if (hit && !there) {
          // Further than the largest number of steps; no proof says that nothing is there.
          ++beyond;
          if (!std::isinf(std::ldexp(hit.t, -exponent)) || q) ++not_so, worst = describe();
          continue;
        }
        ++(there ? hits : misses);
        if (!q) ++unresolved, worst = describe();
        if (!q || !there) continue;
        // Half of the smallest number: what t of a long direction is rounded to.
        const double least = 0x1p-1074, unit = std::ldexp(1.0, std::min(exponent, 1000)),
                     rest = std::ldexp(1.0, exponent - std::min(exponent, 1000));
        const auto in_steps = [&](double x) { return x * unit * rest; };
        t.add(std::fabs(in_steps(there.t) - hit.t), in_steps(q.t_error) + c.t_error, describe);
        t_bound.add(in_steps(q.t_error), 2.0 * c.t_error + in_steps(4.0 * least), describe);
        point_bound.add(q.point_error, 2.0 * c.point_error, describe);
      }
    }
  }
  INFO(hits << " hits, " << misses << " misses, " << unresolved << " unresolved, " << beyond
            << " beyond: " << worst);
  INFO("t: " << t.text());
  INFO("bound of t: " << t_bound.text());
  INFO("bound of the point: " << point_bound.text());
  CHECK(unresolved == 0);
  CHECK(not_so == 0);
  CHECK(t.failures() + t_bound.failures() + point_bound.failures() == 0);
  CHECK(hits > 1000);
  CHECK(beyond > 20);
}

TEST_CASE("Certificates do not depend on the unit of length", "[certificate]") {
  long rays = 0, lost = 0, misled = 0;
  std::string worst = "none";
  for (const char* type : {R"({"type": "sphere_tiling", "topology": "cube"})", R"({"type": "gc_octahedron"})",
                           R"({"type": "sphere"})"}) {
    const Surface unit = build_family(type);
    const Tracer tracer({{unit, Solver::newton}});
    const Certifier certifier(tracer);
    for (const int exponent : {-190, -183, -40, 53, 67, 166, 190}) {
      const Tracer other({{placed(unit, std::ldexp(1.0, exponent), dvec3(0.0)), Solver::newton}});
      const Certifier of_other(other);
      std::mt19937_64 random(19);
      for (int k = 0; k < 50; ++k) {
        const dvec3 from = 3.0 * random_direction(random), d = 0.9 * random_direction(random) - from;
        const Ray ray{from, d}, large{scaled(from, exponent), d};
        const Hit hit = tracer.closest(ray), there = other.closest(large);
        ++rays;
        if (certifier.certify(ray, hit) && !of_other.certify(large, there))
          ++lost, worst = fmt::format("{} times 2^{}, ray {}", type, exponent, k);
        // And what is not so is not certified.
        if (hit && of_other.certify(large, {}))
          ++misled, worst = fmt::format("a miss, {} times 2^{}, ray {}", type, exponent, k);
      }
    }
  }
  INFO(rays << " rays, " << lost << " lost, " << misled << " false proofs: " << worst);
  CHECK(lost == 0);
  CHECK(misled == 0);
}

TEST_CASE("Neither hits nor certificates depend on the size of a net's weights", "[certificate]") {
  long rays = 0, hits = 0, other = 0, lost = 0;
  std::string worst = "none";
  for (const char* type :
       {R"({"type": "sphere_tiling", "topology": "cube"})", R"({"type": "gc_octahedron"})"})
    for (const Solver solver : {Solver::newton, Solver::clipping, Solver::quadric}) {
      const Surface unit = build_family(type);
      const Tracer tracer({{unit, solver}});
      const Certifier certifier(tracer);
      for (const int exponent : {-990, -700, -110, 110, 700, 990}) {
        Surface surface = unit;
        for (Net& net : surface.patches)
          for (dvec4& p : points_of(net)) p = dvec4(scaled(dvec3(p), exponent), std::ldexp(p.w, exponent));
        const Tracer scaled_tracer({{surface, solver}});
        const Certifier of_scaled(scaled_tracer);
        std::mt19937_64 random(23);
        for (int k = 0; k < 20; ++k) {
          const dvec3 from = 3.0 * random_direction(random);
          const Ray ray{from, random_direction(random) - from};
          const Hit hit = tracer.closest(ray), there = scaled_tracer.closest(ray);
          ++rays, hits += static_cast<bool>(hit);
          const auto describe = [&] { return fmt::format("{} times 2^{}, ray {}", type, exponent, k); };
          if (hit.t != there.t || hit.point != there.point || hit.patch != there.patch)
            ++other, worst = describe();
          if (certifier.certify(ray, hit) && !of_scaled.certify(ray, there)) ++lost, worst = describe();
        }
      }
    }
  INFO(rays << " rays, " << other << " other hits, " << lost << " certificates lost: " << worst);
  CHECK(other == 0);
  CHECK(lost == 0);
  CHECK(hits > rays / 2);
}

}  // namespace rondure
