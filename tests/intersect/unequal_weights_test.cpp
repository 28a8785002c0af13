// Nets whose weights differ by many orders: the same sphere, with nearly all of it in a corner of the domain.

#include <fmt/core.h>

#include <glm/geometric.hpp>

#include "renderer/bezier/rational.h"
#include "tests/catch.h"
#include "tests/intersect/closed_models.h"
#include "tests/intersect/random_direction.h"
#include "tests/intersect/sphere_reference.h"
#include "tests/surfaces/build_family.h"
#include "tests/tallied.h"

using namespace rondure;

namespace {

// P_ij times 2^(i a + j b): the surface is the same, and the net as exact.
Surface reparametrised(Surface surface, int a, int b) {
  for (Net& net : surface.patches) {
    auto& tensor = std::get<TensorNet>(net);
    for (int i = 0; i <= tensor.m; ++i)
      for (int j = 0; j <= tensor.n; ++j) tensor.at(i, j) *= std::ldexp(1.0, a * i + b * j);
  }
  return surface;
}

struct Tally {
  long rays = 0, in_band = 0, wrong = 0, loose = 0;
  std::string text;
  void merge(const Tally& o) {
    rays += o.rays, in_band += o.in_band, wrong += o.wrong, loose += o.loose;
    if (text.size() < 1000) text += o.text;
  }
};

}  // namespace

// Of those that pass the sphere by 10^-2 to 10^-11 radii, or graze it as deep, 1 to 9 in a hundred were lost
// or false from 2^9 on, when leaves were no smaller beside little weight.
TEST_CASE("Weights of many orders lose no ray", "[hits]") {
  struct Powers {
    int a, b;
  };
  const Powers all[] = {{4, 0}, {0, -9}, {10, 0}, {5, -5}, {5, 5}};
  const char* const families[] = {R"("type": "sphere_tiling", "topology": "cube")",
                                  R"("type": "sphere_tiling", "topology": "hemispheres")",
                                  R"("type": "sphere_tiling", "topology": "octahedron_pairs")",
                                  R"("type": "sphere_octant")"};
  const Solver solvers[] = {Solver::newton, Solver::clipping, Solver::quadric};
  const Tally tally = tallied<Tally>(60, [&](std::size_t which, Tally& t) {
    const Powers& powers = all[which / 12];
    const char* const family = families[which % 12 / 3];
    const Surface plain = build_family(fmt::format("{{{}}}", family));
    const Surface surface = reparametrised(plain, powers.a, powers.b);
    const Tracer tracer({{surface, solvers[which % 3]}});
    // Four times: a leaf's weights may differ by as much, to which its rounding is relative.
    const double band = 4.0 * tangency_band(plain, 1.0);
    std::mt19937_64 random(which);
    std::uniform_real_distribution<double> digits(2.0, 11.0), part(0.0, 1.0);
    for (int k = 0; k < 120; ++k) {
      // Over any place of the domain, its edges and corners too.
      double u = part(random), v = part(random);
      if (k % 2 == 0) u = std::round(u);
      if (k % 3 == 0) v = std::round(v);
      const Net& net = plain.patches[static_cast<std::size_t>(k) % plain.patches.size()];
      const dvec3 n = glm::normalize(net_point(net, u, v));
      const dvec3 along = glm::normalize(glm::cross(n, random_direction(random)));
      const double off = (k % 4 < 2 ? 1.0 : -1.0) * std::pow(10.0, -digits(random));
      const Ray ray{(1.0 + off) * n - 3.0 * along, along};
      const SphereReference exact = sphere_reference(ray.origin, ray.direction, dvec3(0.0), 1.0);
      const std::vector<Hit> hits = tracer.all(ray);
      ++t.rays;
      const bool right = hits.size() == (exact.clearance < 0.0 ? 2 : 0);
      if (std::fabs(exact.clearance) <= band) {
        t.in_band += !right;
        continue;
      }
      t.wrong += !right;
      for (std::size_t j = 0; j < hits.size() && right; ++j)
        t.loose += !(std::fabs(hits[j].t - exact.t[j]) <= hits[j].t_error + 4.0 * 0x1p-53 * exact.t[1]) ||
                   !(hits[j].t_error < 1e-5);
      if (!right && t.text.size() < 300)
        t.text += fmt::format("\n{} by 2^({}, {}), solver {}, clearance {:.3g}: {} hits", family, powers.a,
                              powers.b, which % 3, exact.clearance, hits.size());
    }
  });
  WARN(tally.rays << " rays, of which " << tally.in_band << " told otherwise in the band");
  INFO(tally.text);
  CHECK(tally.wrong == 0);
  CHECK(tally.loose == 0);
}
