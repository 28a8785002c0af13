// Rays that start where others ended: leaving a convex surface they never meet it again, entering it they
// meet the far wall.

#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <tuple>

#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/placed.h"
#include "tests/intersect/random_direction.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

namespace {

// A direction that makes an angle with the surface of 10^-8 to 1.
dvec3 grazing(const dvec3& normal, std::mt19937_64& random, double side) {
  const double rise = std::pow(10.0, -8.0 * std::uniform_real_distribution<double>(0.0, 1.0)(random));
  return glm::normalize(glm::normalize(glm::cross(normal, random_direction(random))) + side * rise * normal);
}

}  // namespace

TEST_CASE("Rays leaving a convex surface never meet it again, and rays entering it always do", "[hits]") {
  std::mt19937_64 random(17);
  long hits = 0, self_hits = 0, escapes = 0, short_chords = 0;
  std::string worst = "none";
  const char* const cube = R"({"type": "sphere_tiling", "topology": "cube"})";
  const char* const hemispheres = R"({"type": "sphere_tiling", "topology": "hemispheres"})";
  const char* const octants = R"({"type": "sphere_octant"})";
  for (const auto& [family, solver] : {std::pair{cube, Solver::newton},
                                       {hemispheres, Solver::newton},
                                       {octants, Solver::newton},
                                       {cube, Solver::quadric},
                                       {hemispheres, Solver::quadric},
                                       {octants, Solver::quadric},
                                       {R"({"type": "sphere"})", Solver::newton}})
    for (const double radius : {1e-4, 1.0, 1e4})
      for (const double distance : {1e-8, 1.0, 1e8}) {
        // The surface stands `distance` radii from the origin, and the rays come from as far again.
        const dvec3 center = radius * distance * glm::normalize(dvec3(1.0, 2.0, -3.0));
        const Tracer tracer({{placed(build_family(family), radius, center), solver}});
        for (int k = 0; k < 1500; ++k) {
          const dvec3 origin = center + radius * (1.5 + distance) * random_direction(random);
          const double depth = std::uniform_real_distribution<double>(0.0, 1.0)(random);
          const dvec3 target = center + 0.98 * depth * radius * random_direction(random);
          const Hit hit = tracer.closest({origin, target - origin});
          if (!hit) continue;
          ++hits;
          const RayStart start{hit.surface, hit.normal};
          const auto describe = [&](const dvec3& d) {
            return fmt::format(
                "{}, radius {}, distance {}: from ({:.17g}, {:.17g}, {:.17g}) along ({:.17g}, {:.17g}, "
                "{:.17g})",
                family, radius, distance, hit.point.x, hit.point.y, hit.point.z, d.x, d.y, d.z);
          };
          const dvec3 out = grazing(hit.normal, random, 1.0);
          const Ray leaving{hit.point, out, 0.0, INFINITY, start};
          if (tracer.occluded(leaving) || tracer.closest(leaving)) ++self_hits, worst = describe(out);
          const dvec3 in = grazing(hit.normal, random, -1.0);
          const Ray entering{hit.point, in, 0.0, INFINITY, start};
          const Hit far = tracer.closest(entering);
          // A chord shorter than the start's own rounding (an ulp of its coordinates, over the angle) may not
          // show.
          const double chord = -2.0 * radius * glm::dot(in, hit.normal);
          const double doubt = 64.0 * 0x1p-52 * (radius + glm::length(center)) / -glm::dot(in, hit.normal);
          if (chord < doubt) {
            ++short_chords;
            continue;
          }
          if (!far || std::fabs(far.t - chord) > doubt) ++escapes, worst = describe(in);
        }
      }
  INFO(hits << " hits, " << short_chords << " chords too short to tell; worst: " << worst);
  CHECK(self_hits == 0);
  CHECK(escapes == 0);
  CHECK(hits > 45'000);
  CHECK(short_chords < hits / 2);
}

// Where one sphere touches another from within, the space between them is less than rounding: a ray that
// starts on the outer and goes in meets the inner at once, and one that starts on the inner and goes out the
// outer, whichever side of the other's wall rounding put it on.
TEST_CASE("Nested spheres that touch are met from each other", "[hits]") {
  const auto ball = [](const char* family, double radius, const dvec3& center, Solver solver) {
    return TracedSurface{placed(build_family(family), radius, center), solver};
  };
  const char* const cube = R"({"type": "sphere_tiling", "topology": "cube"})";
  const char* const hemispheres = R"({"type": "sphere_tiling", "topology": "hemispheres"})";
  const char* const sphere = R"({"type": "sphere"})";
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  long rays = 0, lost = 0, behind = 0;
  std::string first = "none";
  for (const auto& [outer, inner, solver] : {std::tuple{cube, hemispheres, Solver::newton},
                                             {cube, cube, Solver::quadric},
                                             {hemispheres, sphere, Solver::quadric}})
    for (const dvec3& axis : {dvec3(7.0, 0.0, 0.0), dvec3(2.0, 3.0, 6.0)}) {
      // Of radii 14 and 7, touching at twice the axis, which doubles hold.
      const Tracer tracer({ball(outer, 14.0, dvec3(0.0), solver), ball(inner, 7.0, axis, solver)});
      for (int k = 0; k < 2000; ++k) {
        const dvec3 beside = std::pow(10.0, -8.0 - 9.0 * part(random)) * random_direction(random);
        const dvec3 normal = glm::normalize(axis / 7.0 + beside);
        const int from = k % 2;  // the surface
        const dvec3 start = from == 0 ? 14.0 * normal : axis + 7.0 * normal;
        dvec3 direction = random_direction(random);
        const double rise = glm::dot(direction, normal);
        if (std::fabs(rise) < 1e-3) continue;
        if ((rise > 0.0) != (from == 1)) direction = -direction;
        const Ray ray{start, direction, 0.0, INFINITY, {from, normal}};
        const Hit hit = tracer.closest(ray);
        ++rays, behind += hit && hit.t == 0.0;
        // Both walls and the start are within some ulps of 14 of each other, at right angles to them.
        if (!hit || hit.surface == from || hit.t > 64.0 * 0x1p-52 * 14.0 / std::fabs(rise) ||
            !tracer.occluded(ray)) {
          if (lost++ == 0)
            first = fmt::format("{} in {} from {}: t = {} of {}, rise {}", inner, outer, from, hit.t,
                                hit.surface, rise);
        }
      }
    }
  INFO(lost << " of " << rays << " rays, " << behind << " at once; the first: " << first);
  CHECK(lost == 0);
  CHECK(behind > rays / 10);
}
