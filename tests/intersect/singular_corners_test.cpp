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

}  // namespace rondure
