// Patches bounded by circles: a ray sees the hits of the sphere that lie within their planes. Among them are
// projected rectangles so wide that their nets have negative weights.

#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/sphere_reference.h"
#include "tests/surfaces/build_family.h"
#include "tests/worst_case.h"

using namespace rondure;

namespace {

constexpr double ulp = 0x1p-52;

struct Case {
  std::string object;
  std::vector<dvec4> sides;  // inward: the patch is where each of (n, d) . (p, 1) is positive, |n| = 1
  double condition;          // largest weight of the net over the least of the surface
};

dvec4 side(const dvec3& n, double d) { return dvec4(n, d) / glm::length(n); }

// x0 <= 2 x / (1 - z) <= x1 and the same for y.
Case rectangle(double x0, double x1, double y0, double y1, double condition) {
  return {fmt::format(R"({{"type": "stereographic_patch", "x": [{}, {}], "y": [{}, {}]}})", x0, x1, y0, y1),
          {side({2, 0, x0}, -x0), side({-2, 0, -x1}, x1), side({0, 2, y0}, -y0), side({0, -2, -y1}, y1)},
          condition};
}

Case quad(const std::vector<dvec3>& corners) {
  std::string list;
  std::vector<dvec4> sides;
  for (std::size_t k = 0; k < 4; ++k) {
    const dvec3& p = corners[k];
    list += fmt::format("{}[{}, {}, {}]", k > 0 ? ", " : "", p.x, p.y, p.z);
    sides.push_back(side(glm::cross(p, corners[(k + 1) % 4]), 0.0));
  }
  return {fmt::format(R"({{"type": "spherical_quad", "corners": [{}]}})", list), sides, 2.0};
}

}  // namespace

TEST_CASE("A patch bounded by circles is met exactly inside them", "[hits]") {
  // Squares of half-width a have middle weight 1 - a^2 / 4 where the surface has at least 1, corners 1 + a^2
  // / 2.
  const Case cases[] = {rectangle(-1, 1, -1, 1, 1.5),
                        rectangle(-2, 2, -2, 2, 3.0),
                        rectangle(-4, 4, -4, 4, 9.0),
                        rectangle(-30, 30, -30, 30, 451.0),
                        rectangle(0.5, 7, -3, 0.25, 16.0),
                        quad({{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}}),
                        quad({{3, 0, -0.5}, {0.2, 2, -0.4}, {-1, 0.5, 1}, {0.3, -1, 0.2}}),
                        quad({{0, 0, 1}, {0.01, 0, 1}, {0.02, 0.03, 1}, {0, 0.02, 1}})};
  long hits = 0, skipped = 0, wrong = 0, rays = 0;
  std::string worst = "none";
  WorstCase position;
  for (const Case& c : cases) {
    for (const Solver solver : {Solver::newton, Solver::clipping, Solver::quadric}) {
      const Surface surface = build_family(c.object);
      const Tracer tracer({{surface, solver}});
      std::mt19937_64 random(31);
      std::uniform_real_distribution<double> uniform(-1.0, 1.0);
      const int count = solver != Solver::clipping ? 12'000 : 1'500;
      for (int k = 0; k < count; ++k) {
        const double ox = uniform(random), oy = uniform(random), oz = uniform(random), tx = uniform(random),
                     ty = uniform(random), tz = uniform(random);
        const dvec3 origin = 4.0 * dvec3(ox, oy, oz), target(tx, ty, tz);
        const Ray ray{origin, target - origin};
        const SphereReference exact = sphere_reference(ray.origin, ray.direction, dvec3(0.0), 1.0);
        ++rays;
        std::size_t expected = 0;
        // Where rounding decides, at the silhouette and at the sides: some ulps of the sphere, for wide
        // rectangles more, since their weights cancel.
        bool doubtful = std::fabs(exact.clearance) < 16.0 * c.condition * ulp;
        for (int j = 0; j < 2 && exact.clearance < 0.0; ++j) {
          if (exact.t[j] < 0.0) continue;
          const dvec4 p(origin + exact.t[j] * ray.direction, 1.0);
          double inside = 1.0;
          for (const dvec4& s : c.sides) inside = std::min(inside, glm::dot(s, p));
          doubtful = doubtful || exact.t[j] < 1e-12 ||
                     std::fabs(inside) < 64.0 * c.condition * ulp * (1.0 + 4.0 / exact.cosine);
          if (inside > 0.0) ++expected;
        }
        if (doubtful) {
          ++skipped;
          continue;
        }
        const std::vector<Hit> all = tracer.all(ray);
        hits += static_cast<long>(all.size());
        const auto describe = [&] {
          return fmt::format(
              "{}, o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g}): {} hits, expected {}",
              c.object, origin.x, origin.y, origin.z, ray.direction.x, ray.direction.y, ray.direction.z,
              all.size(), expected);
        };
        if (all.size() != expected) ++wrong, worst = describe();
        for (const Hit& hit : all)
          position.add(std::fabs(glm::length(hit.point) - 1.0), 4.0 * (1.0 + c.condition) * ulp, describe);
      }
    }
  }
  INFO(rays << " rays, " << hits << " hits, " << skipped << " left out; one of the wrong: " << worst);
  INFO("position: " << position.text());
  CHECK(wrong == 0);
  CHECK(position.failures() == 0);
  CHECK(skipped < rays / 1000);
  CHECK(hits > rays / 4);
}
