#include <fmt/core.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "renderer/intersect/ellipsoid.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/ellipsoid_chord.h"
#include "tests/intersect/random_direction.h"
#include "tests/worst_case.h"

using namespace rondure;

namespace {

Surface ellipsoid(const dmat3& map) {
  Surface out;
  out.ellipsoid = map;
  out.closed = true;
  return out;
}

// Turned after the unit sphere is stretched, and before.
dmat3 turned(const dvec3& axes, std::mt19937_64& random) {
  const auto turn = [&](const dmat4& m) {
    return glm::rotate(m, 2.0 + 0.1 * m[0][0], random_direction(random));
  };
  return dmat3(turn(glm::scale(turn(dmat4(1.0)), axes)));
}

}  // namespace

TEST_CASE("Flat and long ellipsoids in general position are met as they are", "[hits]") {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  long rays = 0, wrong = 0, self_hits = 0, escapes = 0;
  WorstCase t;
  for (const double ratio : {1e1, 1e2, 1e3, 1e4, 1e6, 3e7})
    for (const dvec3& axes : {dvec3(1.0, 1.0, 1.0 / ratio), dvec3(1.0, 1.0 / ratio, 1.0 / ratio),
                              dvec3(1.0, std::sqrt(1.0 / ratio), 1.0 / ratio)})
      for (int turn = 0; turn < 4; ++turn) {
        const dmat3 map = turn == 0 ? dmat3(glm::scale(dmat4(1.0), axes)) : turned(axes, random);
        REQUIRE(!is_too_flat(map));
        const Tracer tracer({{ellipsoid(map), Solver::newton}});
        const EllipsoidReference exact(map, dvec3(0.0));
        for (int k = 0; k < 500; ++k) {
          // From outside and inside, at a point of the surface.
          const dvec3 origin = k % 3 == 0 ? map * (0.9 * part(random) * random_direction(random))
                                          : (1.1 + 2.0 * part(random)) * random_direction(random);
          const Ray ray{origin, map * random_direction(random) - origin};
          const auto describe = [&] {
            return fmt::format(
                "ratio {}, turn {}: o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g})", ratio,
                turn, ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
                ray.direction.z);
          };
          const EllipsoidChord chord = exact.chord(ray.origin, ray.direction);
          ++rays;
          const std::vector<Hit> hits = tracer.all(ray);
          double expected[2];
          std::size_t count = 0;
          for (const double at : chord.t)
            if (chord.clearance < 0.0 && at >= 0.0) expected[count++] = at;
          if (hits.size() != count) {
            // A start within rounding of the surface.
            wrong += !(std::fabs(chord.t[0]) < 1e-14 * ratio || std::fabs(chord.t[1]) < 1e-14 * ratio);
            continue;
          }
          for (std::size_t j = 0; j < count; ++j) {
            t.add(std::fabs(hits[j].t - expected[j]), hits[j].t_error + 0x1p-53 * expected[j], describe);
            const dvec3 d = random_direction(random);
            const double rise = glm::dot(d, hits[j].normal);
            if (std::fabs(rise) < 0.1) continue;
            const Ray on{hits[j].point, d, 0.0, INFINITY, {0, hits[j].normal}};
            if (rise > 0.0) {
              self_hits += tracer.occluded(on);
            } else {
              const EllipsoidChord inside = exact.chord(on.origin, on.direction);
              const Hit far = tracer.closest(on);
              // The start is off by some roundoffs.
              escapes += !(far && std::fabs(far.t - inside.t[1]) <=
                                      far.t_error + 32.0 * 0x1p-53 / std::max(inside.cosine[1], 1e-15));
            }
          }
        }
      }
  INFO(rays << " rays; t: " << t.text());
  CHECK(wrong == 0);
  CHECK(t.failures() == 0);
  CHECK(self_hits == 0);
  CHECK(escapes == 0);
  CHECK(t.count() > rays / 2);
}

// Within the flattest that is allowed, where rounding moves the ray most.
TEST_CASE("A flat ellipsoid keeps its outline", "[hits]") {
  Surface flat;
  flat.ellipsoid = dmat3(1.0);
  (*flat.ellipsoid)[2][2] = 2.0 / flattest_ellipsoid;
  REQUIRE(!is_too_flat(*flat.ellipsoid));
  const Tracer tracer({{flat, Solver::newton}});
  long lost = 0, invented = 0;
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int k = 0; k < 10'000; ++k) {
    const double turn = 6.3 * part(random), beside = std::pow(10.0, -1.0 - 13.0 * part(random));
    const auto hits = [&](double radius) {
      const dvec3 origin(radius * std::cos(turn), radius * std::sin(turn), -1.0 - part(random));
      return tracer.all({origin, dvec3(0.0, 0.0, 1.0)}).size();
    };
    lost += hits(1.0 - beside) != 2, invented += hits(1.0 + beside) != 0;
  }
  INFO(lost << " lost, " << invented << " invented of 10000 each");
  CHECK(lost == 0);
  CHECK(invented == 0);
}
