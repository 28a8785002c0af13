// Newton's method on one leaf: the same bits on every instruction set that it is compiled for, and proofs
// that hold.

#include "renderer/intersect/newton.h"

#include <fmt/core.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <random>

#include "renderer/bezier/rational.h"
#include "tests/catch.h"
#include "tests/surfaces/build_family.h"

using namespace rondure;

namespace {

struct Answer {
  NewtonVerdict verdict;
  NewtonRoot found;
};

Answer ask(Instructions set, const Leaf& leaf, const Net& net, const LocalRay& ray) {
  Answer a{};
  NewtonCounts counts;
  const NewtonPatch patch = newton_patch(net, set);
  a.verdict = patch.on_leaf(leaf, patch, ray, residual_bound(leaf.scale, ray), a.found, counts);
  return a;
}

bool same_bits(const Answer& a, const Answer& b) {
  if (a.verdict != b.verdict) return false;
  const auto &f = a.found.surface, &g = b.found.surface;
  return a.verdict != NewtonVerdict::root ||
         (a.found.root.u == b.found.root.u && a.found.root.v == b.found.root.v && f.value == g.value &&
          f.du == g.du && f.dv == g.dv);
}

const char* const families[] = {R"({"type": "sphere_tiling", "topology": "cube"})",
                                R"({"type": "sphere_tiling", "topology": "hemispheres"})",
                                R"({"type": "sphere_octant"})",
                                R"({"type": "sphere_tiling", "topology": "octahedron_pairs"})",
                                R"({"type": "iss", "octants": {"degree": 7, "interior": 1}})"};

enum class Way { any, grazing };

// Through points of the patch, most of them somewhere near the leaf: from every side, or grazing the patch
// there at any small angle.
template <class Visit>
void visit_rays(Way way, const Visit& visit) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const char* family : families) {
    const Surface surface = build_family(family);
    const LeafSet set = build_leaves(surface.patches, 9);
    for (int k = 0; k < 6000; ++k) {
      const Leaf& leaf = set.leaves[static_cast<std::size_t>(uniform(random) * double(set.leaves.size()))];
      const Net& net = surface.patches[static_cast<std::size_t>(leaf.patch)];
      const double a = 1.6 * uniform(random) - 0.3, b = 1.6 * uniform(random) - 0.3;
      const dvec2 at = leaf.to_patch({a, b});
      const double x = normal(random), y = normal(random), z = normal(random);
      const dvec3 target = net_point(net, at.x, at.y), normal_there = unit_normal(net, at.x, at.y);
      dvec3 direction = glm::normalize(dvec3(x, y, z));
      if (way == Way::grazing) {
        const double along = glm::dot(direction, normal_there), angle = std::exp2(-30.0 * uniform(random));
        direction = glm::normalize(direction + (std::copysign(angle, along) - along) * normal_there);
      }
      LocalRay ray;
      if (make_local_ray(target - 3.0 * direction, direction, dvec3(0.0), ray))
        visit(leaf, net, ray, at, dvec2(a, b));
    }
  }
}

struct Aimed {
  long rays = 0, lost = 0, found = 0, open = 0;
  std::string worst = "none";

  std::string text() const {
    return fmt::format("{} rays, {} found, {} left open, {} lost; {}", rays, found, open, lost, worst);
  }
};

// `tolerance`: of a root's parameters.
Aimed aimed_at_roots(Way way, double tolerance) {
  Aimed tally;
  visit_rays(way, [&](const Leaf& leaf, const Net& net, const LocalRay& ray, dvec2 at, dvec2 local) {
    const double outside =
        std::holds_alternative<TensorNet>(net) ? TensorShape::outside(local) : TriangleShape::outside(local);
    if (outside > -1e-9) return;
    const Answer a = ask(Instructions::baseline, leaf, net, ray);
    ++tally.rays;
    const Root& r = a.found.root;
    if (a.verdict == NewtonVerdict::undecided) {
      ++tally.open;
    } else if (a.verdict == NewtonVerdict::root && std::fabs(r.u - at.x) < tolerance &&
               std::fabs(r.v - at.y) < tolerance) {
      ++tally.found;
    } else {
      ++tally.lost;
      tally.worst = fmt::format("patch {}, (u, v) = ({:.17g}, {:.17g})", leaf.patch, at.x, at.y);
    }
  });
  return tally;
}

}  // namespace

TEST_CASE("Newton's method gives the same bits on every instruction set", "[solvers]") {
  if (!has(Instructions::avx2)) WARN("this machine has the baseline only");
  long rays = 0, roots = 0, different = 0;
  for (const Way way : {Way::any, Way::grazing})
    visit_rays(way, [&](const Leaf& leaf, const Net& net, const LocalRay& ray, dvec2, dvec2) {
      const Answer baseline = ask(Instructions::baseline, leaf, net, ray);
      ++rays;
      roots += baseline.verdict == NewtonVerdict::root;
      if (has(Instructions::avx2)) different += !same_bits(baseline, ask(Instructions::avx2, leaf, net, ray));
    });
  INFO(rays << " rays, " << roots << " roots");
  CHECK(different == 0);
  CHECK(roots > rays / 8);
}

TEST_CASE("Newton's method finds the root that a ray was aimed at, or leaves it open", "[solvers]") {
  // The point, rounded, is off by 4 roundoffs of its size, which the leaf's parameters see magnified by at
  // most 10^3.
  const Aimed any = aimed_at_roots(Way::any, 1e-12);
  INFO(any.text());
  CHECK(any.lost == 0);
  CHECK(any.found > any.rays * 8 / 10);
}

TEST_CASE("Newton's method finds the root of a ray that grazes, or leaves it open", "[solvers]") {
  // Ten times as much where the ray grazes the leaf and there is still one root at most.
  const Aimed grazing = aimed_at_roots(Way::grazing, 1e-11);
  INFO(grazing.text());
  CHECK(grazing.lost == 0);
  CHECK(grazing.found > grazing.rays / 20);
}
