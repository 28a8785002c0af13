// Rays at where patches meet in singular corners, each patch in a parametrisation of its own. No two nets
// round alike then: a corner is as many points as it has patches, and of a root beside it, 1e-9 inside of one
// of them, rounding leaves no more than that it is there.

#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/closed_models.h"
#include "tests/intersect/mapped.h"
#include "tests/intersect/random_direction.h"
#include "tests/soak.h"
#include "tests/surfaces/build_family.h"

namespace rondure {
namespace {

// Control point (i, j) times a^i b^j: the same patch at other parameters, but for rounding.
Net reparametrised(Net net, double a, double b) {
  const auto factor = [&](int i, int j) { return std::pow(a, i) * std::pow(b, j); };
  if (auto* tensor = std::get_if<TensorNet>(&net)) {
    for (int i = 0; i <= tensor->m; ++i)
      for (int j = 0; j <= tensor->n; ++j) tensor->at(i, j) *= factor(i, j);
    return net;
  }
  auto& triangle = std::get<TriangleNet>(net);
  for (int i = 0; i <= triangle.n; ++i)
    for (int j = 0; j <= triangle.n - i; ++j) triangle.at(i, j) *= factor(i, j);
  return net;
}

// Parameters within 10^-6 to 10^-12 of a corner, in the domain.
dvec2 beside_corner(const Net& net, std::mt19937_64& random) {
  const auto draw = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  const double size = std::pow(10.0, -6.0 - 6.0 * draw());
  dvec2 p{draw(), draw()};
  if (!std::holds_alternative<TriangleNet>(net))
    return {draw() < 0.5 ? size * p.x : 1.0 - size * p.x, draw() < 0.5 ? size * p.y : 1.0 - size * p.y};
  if (p.x + p.y > 1.0) p = 1.0 - p;
  constexpr dvec2 corners[3] = {{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}};
  const dvec2 q = corners[random() % 3] * (1.0 - size) + size * p;
  return {q.x, std::min(q.y, 1.0 - q.x)};
}

}  // namespace

TEST_CASE("No ray passes beside a singular corner of patches that are parametrised each in its own way",
          "[hits][seams]") {
  std::mt19937_64 random(31);
  const auto draw = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  constexpr int placings = 3;
  const long aimed = static_cast<long>(soaked(250, 20'000));
  long rays = 0, wrong = 0;
  std::string text, worst = "none";
  for (const char* topology : {"hemispheres", "octahedron_pairs"})
    // Of the tiling's centre from the frame's zero. Nets far from that round by so much more, but both
    // patches of a seam do.
    for (const double distance : {0.0, 1e3})
      for (const auto& [solver, name] : {std::pair{Solver::newton, "newton"},
                                         {Solver::clipping, "clipping"},
                                         {Solver::quadric, "quadric"}}) {
        long here = 0;
        for (int placing = 0; placing < placings; ++placing) {
          const dvec3 center = distance * random_direction(random);
          const double angle = 6.3 * draw();
          const dmat4 turn = glm::rotate(dmat4(1.0), angle, random_direction(random));
          Surface surface =
              mapped(build_family(fmt::format(R"({{"type": "sphere_tiling", "topology": "{}"}})", topology)),
                     glm::translate(dmat4(1.0), center) * turn);
          surface.joins.clear();
          for (Net& net : surface.patches) {
            const dvec2 power{draw(), draw()};
            net = reparametrised(net, std::exp2(2.0 * power.x - 1.0), std::exp2(2.0 * power.y - 1.0));
          }
          const std::vector<Net>& nets = surface.patches;
          const Tracer tracer({{surface, solver}});
          for (long k = 0; k < aimed; ++k) {
            const Net& net = nets[random() % nets.size()];
            const dvec2 p = beside_corner(net, random);
            const bool outside = k % 2 == 1;
            const dvec3 origin = center + (outside ? 4.0 : 0.5) * random_direction(random);
            const dvec3 target = net_point(net, p.x, p.y);
            const Ray ray{origin, target - origin};
            // Where it grazes, its number of hits is rounding's.
            if (std::fabs(glm::dot(glm::normalize(target - center), glm::normalize(ray.direction))) < 0.05)
              continue;
            const std::vector<Hit> hits = tracer.all(ray);
            long at_corner = 0;
            for (const Hit& hit : hits) at_corner += std::fabs(hit.t - 1.0) < 1e-6;
            ++rays;
            const std::size_t walls = outside ? 2 : 1;
            if (at_corner == 1 && hits.size() == walls &&
                static_cast<bool>(tracer.closest(ray)) == tracer.occluded(ray))
              continue;
            ++wrong, ++here;
            worst = fmt::format(
                "{} {} from zero, {}: {} hits, {} of them where it is aimed, o = ({:.17g}, "
                "{:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g})",
                topology, distance, name, hits.size(), at_corner, origin.x, origin.y, origin.z,
                ray.direction.x, ray.direction.y, ray.direction.z);
          }
        }
        if (here > 0) text += fmt::format("\n  {} of {} at {}, {}", here, topology, distance, name);
      }
  INFO(wrong << " of " << rays << " rays are met wrongly; the last: " << worst << text);
  CHECK(wrong == 0);
  CHECK(rays > 2 * 2 * 3 * placings * aimed * 9 / 10);
}

// So near that both roots are beside the corner, where parameters tell next to nothing of the place: ten
// times as deep as rounding hides (tangency_band), down to 10^-9 radii.
TEST_CASE("A ray that passes beneath a singular corner meets both walls", "[hits][seams]") {
  std::mt19937_64 random(37);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  struct Ball {
    const char* object;
    double part;  // a ray beside the corner of a tiling costs milliseconds
  };
  const double aimed = soaked(4000, 400'000);
  long wrong = 0;
  std::string text, worst = "none";
  for (const auto& [object, part] : {Ball{R"({"type": "sphere_octant"})", 1.0},
                                     {R"({"type": "sphere_tiling", "topology": "hemispheres"})", 0.03},
                                     {R"({"type": "sphere_tiling", "topology": "octahedron_pairs"})", 0.03}})
    for (const auto& [solver, name] : {std::pair{Solver::newton, "newton"}, {Solver::clipping, "clipping"}}) {
      const Tracer tracer({{build_family(object), solver}});
      const std::vector<Net>& nets = tracer.surfaces()[0].surface.patches;
      const double band = tangency_band(tracer.surfaces()[0].surface, 1.0);
      const long rays = static_cast<long>(part * aimed);
      long here = 0;
      for (long k = 0; k < rays; ++k) {
        const Net& net = nets[random() % nets.size()];
        constexpr dvec2 corners[4] = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}};
        const dvec2 at = corners[random() % (std::holds_alternative<TriangleNet>(net) ? 3 : 4)];
        const dvec3 up = glm::normalize(net_point(net, at.x, at.y));
        const dvec3 level = glm::normalize(glm::cross(up, random_direction(random)));
        const double depth = std::pow(10.0, draw(std::log10(10.0 * band), -9.0));
        // Straight beneath, or so far to the side that a quarter of the depth is lost at most; and level but
        // for rounding, which depends on how planes lie about the ray.
        const double side = k % 2 == 0 ? 0.0 : std::sqrt(0.5 * depth) * std::pow(10.0, draw(-4.0, 0.0));
        const dvec3 direction = level + draw(-1e-16, 1e-16) * up;
        const Ray ray{(1.0 - depth) * up + side * glm::cross(up, level) - draw(1.0, 4.0) * direction,
                      direction};
        const std::vector<Hit> hits = tracer.all(ray);
        const Hit closest = tracer.closest(ray);
        if (hits.size() == 2 && closest.t == hits[0].t && tracer.occluded(ray)) continue;
        ++wrong, ++here;
        worst = fmt::format(
            "depth {:.3g}: {} hits, o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g})", depth,
            hits.size(), ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
            ray.direction.z);
      }
      if (here > 0) text += fmt::format("\n  {} of {} at {} by {}", here, rays, object, name);
    }
  INFO(wrong << " rays are met wrongly; the last: " << worst << text);
  CHECK(wrong == 0);
}

}  // namespace rondure
