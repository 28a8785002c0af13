// Spherical caps are open: a ray sees the hits of the sphere that lie below the rim, whatever z_max is.

#include <fmt/core.h>

#include <cmath>
#include <random>

#include "renderer/bezier/quotient.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/sphere_reference.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

using namespace rondure;

namespace {

struct Cap {
  double z_max;
  double middle_weight;  // 0: the family's own
};

// Half of the rays go anywhere, half toward the pole, where caps near the whole sphere have their rim and the
// steepest parameters.
Ray cap_ray(std::mt19937_64& random, bool at_pole) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double ox = uniform(random), oy = uniform(random), oz = uniform(random), tx = uniform(random),
               ty = uniform(random), tz = uniform(random);
  const dvec3 origin = 4.0 * dvec3(ox, oy, oz);
  if (!at_pole) return Ray{origin, dvec3(tx, ty, tz) - origin};
  const double off = std::pow(10.0, -7.0 + 7.0 * tz);
  return Ray{origin, glm::normalize(dvec3(off * tx, off * ty, 1.0)) - origin};
}

// Ends of the accepted range, and what is usual.
const Cap caps[] = {
    {-0.9, 0},   {-0.6, 0},     {0.0, 0},         {0.0, 1e-3},           {0.0, 1e6},         {0.6, 0},
    {0.6, 1e-3}, {0.8, 1e-3},   {12.0 / 13.0, 0}, {12.0 / 13.0, 1.0},    {0.99, 10.2},       {0.9999, 138.5},
    {0.9999, 0}, {0.9999, 1e6}, {1.0 - 1e-9, 0},  {1.0 - 1e-9, 45000.0}, {1.0 - 1e-9, 1.9e9}};

}  // namespace

TEST_CASE("A cap is met exactly where the sphere below its rim is", "[hits]") {
  constexpr double ulp = 0x1p-52;
  long hits = 0, skipped = 0, wrong = 0, rays = 0;
  std::string worst = "none";
  WorstCase position, place;
  for (const auto& [z_max, middle_weight] : caps) {
    std::string object = fmt::format(R"({{"type": "sphere_cap", "z_max": {:.17g})", z_max);
    if (middle_weight > 0.0) object += fmt::format(R"(, "middle_weight": {:.17g})", middle_weight);
    for (const Solver solver : {Solver::newton, Solver::quadric}) {
      const Tracer tracer({{build_family(object + "}"), solver}});
      // The paper's own weight on its steepest example is let by: its weights cancel to a tenth.
      const double tolerance = (z_max > 0.9 && middle_weight == 1.0 ? 16.0 : 8.0) * ulp;
      std::mt19937_64 random(11);
      for (int k = 0; k < 12'000; ++k) {
        const Ray ray = cap_ray(random, k % 2 == 1);
        const dvec3& origin = ray.origin;
        const SphereReference exact = sphere_reference(ray.origin, ray.direction, dvec3(0.0), 1.0);
        ++rays;
        std::size_t expected = 0;
        double reference[2];
        // At the rim and at the silhouette rounding decides: 64 ulps, divided by the cosine that stretches
        // them along the ray.
        bool doubtful = std::fabs(exact.clearance) < 16.0 * ulp;
        for (int j = 0; j < 2 && exact.clearance < 0.0; ++j) {
          if (exact.t[j] < 0.0) continue;
          const double z = origin.z + exact.t[j] * ray.direction.z;
          doubtful = doubtful || std::fabs(z - z_max) < 64.0 * ulp * (1.0 + 4.0 / exact.cosine) ||
                     exact.t[j] < 1e-12;
          if (z < z_max) reference[expected++] = exact.t[j];
        }
        if (doubtful) {
          ++skipped;
          continue;
        }
        const std::vector<Hit> all = tracer.all(ray);
        hits += static_cast<long>(all.size());
        const auto describe = [&] {
          return fmt::format(
              "z_max {:.17g}, middle weight {}, o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, "
              "{:.17g}): {} hits, expected {}",
              z_max, middle_weight, origin.x, origin.y, origin.z, ray.direction.x, ray.direction.y,
              ray.direction.z, all.size(), expected);
        };
        for (const Hit& hit : all) position.add(std::fabs(glm::length(hit.point) - 1.0), tolerance, describe);
        if (all.size() != expected) {
          ++wrong, worst = describe();
          continue;
        }
        // As on the closed families: the ray's way through so many ulps of the sphere, and t's own rounding.
        const double kappa = quotient(1.0, glm::length(ray.direction) * exact.cosine);
        for (std::size_t j = 0; j < expected; ++j)
          place.add(std::fabs(all[j].t - reference[j]), tolerance * (std::fabs(reference[j]) + kappa),
                    describe);
      }
    }
  }
  INFO(rays << " rays, " << hits << " hits, " << skipped
            << " left out as doubtful; one of the wrong: " << worst);
  INFO("position: " << position.text());
  CHECK(wrong == 0);
  INFO("t: " << place.text());
  CHECK(position.failures() == 0);
  CHECK(place.failures() == 0);
  CHECK(skipped < rays / 1000);
  CHECK(hits > rays / 2);
}
