#include <fmt/core.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

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
