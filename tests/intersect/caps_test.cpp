// Spherical caps are open: a ray sees the hits of the sphere that lie below the rim, whatever z_max is.

#include <fmt/core.h>

#include <random>

#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/sphere_reference.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

using namespace rondure;

TEST_CASE("A cap is met exactly where the sphere below its rim is", "[hits]") {
  constexpr double ulp = 0x1p-52;
  long hits = 0, skipped = 0, wrong = 0, rays = 0;
  std::string worst = "none";
  WorstCase position;
  for (const double z_max : {-0.9, -0.6, 0.0, 0.3, 0.6, 12.0 / 13.0, 0.99, 0.9999, 0.999999}) {
    const Tracer tracer({{build_family(fmt::format(R"({{"type": "sphere_cap", "z_max": {:.17g}}})", z_max)),
                          Solver::newton}});
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int k = 0; k < 60'000; ++k) {
      const double ox = uniform(random), oy = uniform(random), oz = uniform(random), tx = uniform(random),
                   ty = uniform(random), tz = uniform(random);
      const dvec3 origin = 4.0 * dvec3(ox, oy, oz), target(tx, ty, tz);
      const Ray ray{origin, target - origin};
      const SphereReference exact = sphere_reference(ray.origin, ray.direction, dvec3(0.0), 1.0);
      ++rays;
      std::size_t expected = 0;
      // At the rim and at the silhouette rounding decides: 64 ulps, divided by the cosine that stretches them
      // along the ray.
      bool doubtful = std::fabs(exact.clearance) < 16.0 * ulp;
      for (int j = 0; j < 2 && exact.clearance < 0.0; ++j) {
        if (exact.t[j] < 0.0) continue;
        const double z = origin.z + exact.t[j] * ray.direction.z;
        doubtful =
            doubtful || std::fabs(z - z_max) < 64.0 * ulp * (1.0 + 4.0 / exact.cosine) || exact.t[j] < 1e-12;
        if (z < z_max) ++expected;
      }
      if (doubtful) {
        ++skipped;
        continue;
      }
      const std::vector<Hit> all = tracer.all(ray);
      hits += static_cast<long>(all.size());
      const auto describe = [&] {
        return fmt::format(
            "z_max {:.17g}, o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g}): {} hits, "
            "expected {}",
            z_max, origin.x, origin.y, origin.z, ray.direction.x, ray.direction.y, ray.direction.z,
            all.size(), expected);
      };
      if (all.size() != expected) ++wrong, worst = describe();
      // The caps' nets carry weights up to a hundred times apart near z_max = 1: 64 ulps.
      for (const Hit& hit : all)
        position.add(std::fabs(glm::length(hit.point) - 1.0), (z_max > 0.9 ? 64.0 : 8.0) * ulp, describe);
    }
  }
  INFO(rays << " rays, " << hits << " hits, " << skipped
            << " left out as doubtful; one of the wrong: " << worst);
  INFO("position: " << position.text());
  CHECK(wrong == 0);
  CHECK(position.failures() == 0);
  CHECK(skipped < rays / 1000);
  CHECK(hits > rays / 4);
}
