#include <fmt/core.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/mapped.h"
#include "tests/intersect/random_direction.h"
#include "tests/oracle/oracle.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

using namespace rondure;

// A net that was moved before it was rounded misses its sphere by roundoffs of where it is: what is true of
// the sphere then is not of the patch, whose own roots the oracle finds.
TEST_CASE("The error that a hit tells of its t bounds it, far from the frame's zero too", "[hits]") {
  long rays = 0, hits = 0, unknown = 0;
  WorstCase t;
  for (const char* topology : {"cube", "octahedron_pairs", "hemispheres"}) {
    const Surface unit =
        build_family(fmt::format(R"({{"type": "sphere_tiling", "topology": "{}"}})", topology));
    for (const double distance : {0.0, 3.0, 60.0}) {
      const dvec3 center = distance * glm::normalize(dvec3(0.9, -0.4, 0.2));
      const Surface surface = mapped(unit, glm::translate(dmat4(1.0), center));
      for (const Solver solver : {Solver::quadric, Solver::newton}) {
        const Tracer tracer({{surface, solver}});
        if (solver == Solver::quadric) CHECK(tracer.statistics().leaves == 1);
        std::mt19937_64 random(5);
        for (int k = 0; k < 60; ++k) {
          const dvec3 direction = random_direction(random);
          const dvec3 target = center + 0.9 * random_direction(random);
          const Ray ray{target - 3.0 * direction, direction};
          const oracle::Meeting truth = oracle::meet(surface, ray);
          ++rays, unknown += truth.exhausted;
          for (const Hit& hit : tracer.all(ray)) {
            double off = INFINITY;
            for (const oracle::Root& root : truth.roots) off = std::fmin(off, std::fabs(root.t - hit.t));
            ++hits;
            // The oracle's root is rounded to a double.
            t.add(off, hit.t_error + 0x1p-53 * hit.t, [&] {
              return fmt::format("{} at {}, solver {}: t = {:.17g} with {:.3g}", topology, distance,
                                 static_cast<int>(solver), hit.t, hit.t_error);
            });
          }
        }
      }
    }
  }
  INFO(rays << " rays, " << hits << " hits; " << t.text());
  CHECK(t.failures() == 0);
  CHECK(unknown == 0);
  CHECK(hits > rays);
}

// Where a side is a point, tangents along it are rounding; the error that grazing makes of a point's is not.
TEST_CASE("The error that a hit tells of its t bounds it beside a collapsed side", "[hits]") {
  long rays = 0, missed = 0;
  WorstCase t;
  for (const char* family : {R"({"type": "sphere_octant"})",
                             R"({"type": "iss", "octants": {"degree": 3}, "form": "degenerate"})"}) {
    const Surface surface =
        mapped(build_family(family), glm::rotate(dmat4(1.0), 1.234, glm::dvec3(1.0, 2.0, 3.0)));
    const Tracer tracer({{surface, Solver::newton}});
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    for (int k = 0; k < 300; ++k) {
      const Net& net = surface.patches[random() % surface.patches.size()];
      const double along = part(random), near = std::pow(10.0, -10.0 - 6.0 * part(random));
      double u = along, v = k % 2 == 0 ? near : 1.0 - near;
      if (k % 4 > 1) std::swap(u, v);
      if (std::holds_alternative<TriangleNet>(net) && u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      const dvec3 target = net_point(net, u, v), normal = unit_normal(net, u, v);
      dvec3 direction = random_direction(random);
      direction -= glm::dot(direction, normal) * normal;
      direction = glm::normalize(glm::normalize(direction) - std::pow(10.0, -5.0 * part(random)) * normal);
      const Ray ray{target - 4.0 * direction, direction};
      const Hit hit = tracer.closest(ray);
      ++rays, missed += !hit;
      if (!hit) continue;
      // Beside an edge the root may be the neighbour's, or to the last bit nobody's.
      double off = INFINITY;
      for (const oracle::Root& root : oracle::meet(surface, ray, 0x1p-40).roots)
        off = std::fmin(off, std::fabs(root.t - hit.t));
      t.add(off, hit.t_error + 0x1p-53 * hit.t, [&] {
        return fmt::format("{}: t = {:.17g} with {:.3g}, cosine {:.3g}, patch {} at ({:.17g}, {:.17g})",
                           family, hit.t, hit.t_error, glm::dot(hit.normal, direction), hit.patch, hit.u,
                           hit.v);
      });
    }
  }
  INFO(missed << " of " << rays << " rays meet nothing; " << t.text());
  CHECK(t.failures() == 0);
  CHECK(missed == 0);
}
