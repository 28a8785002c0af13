// Rays from inside at where patches meet: a root there lies beside one patch, or both, by rounding, and
// counts on one of them at least.

#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <random>

#include "renderer/bezier/rational.h"
#include "renderer/bezier/tensor.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/placed.h"
#include "tests/intersect/random_direction.h"
#include "tests/soak.h"
#include "tests/surfaces/build_family.h"

namespace rondure {
namespace {

struct Model {
  const char* name;
  const char* object;
  bool pieces;
  double depth;  // of the ball about the origin that rays start in; 0: at the origin, from where the surface
                 // is a function of direction
};

constexpr Model models[] = {
    {"cube", R"({"type": "sphere_tiling", "topology": "cube"})", false, 0.9},
    {"cube in pieces", R"({"type": "sphere_tiling", "topology": "cube"})", true, 0.9},
    {"rhombicuboctahedron in pieces", R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron"})", true,
     0.9},
    {"hemispheres", R"({"type": "sphere_tiling", "topology": "hemispheres"})", false, 0.9},
    {"icosahedron pairs", R"({"type": "sphere_tiling", "topology": "icosahedron_pairs"})", false, 0.9},
    {"rhombicuboctahedron", R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron"})", false, 0.9},
    {"octants", R"({"type": "sphere_octant"})", false, 0.9},
    {"pebble", R"({"type": "iss", "octants": {"degree": 3, "interior": 1}})", false, 0.0},
    {"quartic octants", R"({"type": "iss",
      "vertices": [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
      "patches": [{"sphere": [0, 2, 4]}, {"sphere": [1, 2, 4]}, {"sphere": [0, 3, 4]}, {"sphere": [1, 3, 4]},
                  {"sphere": [0, 2, 5]}, {"sphere": [1, 2, 5]}, {"sphere": [0, 3, 5]}, {"sphere": [1, 3, 5]}]})",
     false, 0.9},
};

// Of a side, every sixth time a corner; at the middle of sides, too, where coordinates are the same number.
dvec3 seam_point(const Net& net, std::mt19937_64& random) {
  const auto draw = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  const double kind = draw(), s = kind < 1.0 / 6.0 ? 0.0 : kind < 0.25 ? 0.5 : draw();
  const double side = draw();
  if (std::holds_alternative<TriangleNet>(net))
    return side < 1.0 / 3.0   ? net_point(net, s, 0.0)
           : side < 2.0 / 3.0 ? net_point(net, 0.0, s)
                              : net_point(net, s, 1.0 - s);
  const double other = draw() < 0.5 ? 0.0 : 1.0;
  return side < 0.5 ? net_point(net, s, other) : net_point(net, other, s);
}

// Every patch in 64 pieces: small ones, whose parameters round by less than their points. Halving the one
// side of two patches gives both the same bits.
Surface in_pieces(Surface surface) {
  for (int round = 0; round < 6; ++round) {
    std::vector<Net> halves;
    for (const Net& net : surface.patches) {
      const auto& whole = std::get<TensorNet>(net);
      TensorNet low = whole, high = whole;
      if (round % 2 == 0)
        tensor_halve_u(whole.points.data(), whole.m, whole.n, low.points.data(), high.points.data());
      else
        tensor_halve_v(whole.points.data(), whole.m, whole.n, low.points.data(), high.points.data());
      halves.insert(halves.end(), {low, high});
    }
    surface.patches = halves;
  }
  return surface;
}

}  // namespace

TEST_CASE("No ray passes where patches meet", "[hits][seams]") {
  std::mt19937_64 random(29);
  long rays = 0, lost = 0, twice = 0;
  std::string text, worst = "none";
  for (const Model& model : models)
    for (const auto& [solver, name] : {std::pair{Solver::newton, "newton"},
                                       {Solver::clipping, "clipping"},
                                       {Solver::radial, "radial"},
                                       {Solver::quadric, "quadric"}}) {
      const double radius = 0.7;  // no power of two
      const dvec3 center = solver == Solver::newton ? dvec3(0.0) : dvec3(3.1, -2.2, 0.9);
      Surface unit = build_family(model.object);
      if (model.pieces) unit = in_pieces(unit);
      const Tracer tracer({{placed(unit, radius, center), solver}});
      const std::vector<Net>& nets = tracer.surfaces()[0].surface.patches;
      long here = 0;
      for (int k = 0; k < (solver == Solver::clipping ? 500 : 3000); ++k) {
        const Net& net = nets[std::uniform_int_distribution<std::size_t>(0, nets.size() - 1)(random)];
        const double part = std::uniform_real_distribution<double>(0.0, 1.0)(random);
        const dvec3 origin = center + model.depth * radius * std::cbrt(part) * random_direction(random);
        const Ray ray{origin, center + seam_point(net, random) - origin};
        const std::size_t hits = tracer.all(ray).size();
        ++rays, lost += hits == 0, twice += hits > 1, here += hits == 0;
        if (hits != 1 || static_cast<bool>(tracer.closest(ray)) != tracer.occluded(ray))
          worst = fmt::format(
              "{}, {}: {} hits, o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g})", model.name,
              name, hits, origin.x, origin.y, origin.z, ray.direction.x, ray.direction.y, ray.direction.z);
      }
      if (here > 0) text += fmt::format("\n  {} of {}, {}", here, model.name, name);
    }
  INFO(rays << " rays, " << lost << " lost, " << twice << " met twice; the last: " << worst << text);
  CHECK(lost == 0);
  CHECK(twice == 0);
  CHECK(worst == "none");
  CHECK(rays == 9 * (3 * 3000 + 500));
}

// Through two points of one side, in the level plane in which the walls of a house bend into its roof: the
// ray grazes the side twice, in points that no equation but the side's own tells apart.
TEST_CASE("The closest hit of a ray along a side is the first of all", "[hits][seams]") {
  const Surface house = build_family(R"({"type": "gc_complex", "degree": 4,
    "complex": {"polygons": [[3, 2, 1, 0], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7],
      [4, 5, 8], [5, 6, 8], [6, 7, 8], [7, 4, 8]]},
    "vertices": [[-0.8, -0.8, -0.8], [0.8, -0.8, -0.8], [0.8, 0.8, -0.8], [-0.8, 0.8, -0.8],
      [-0.8, -0.8, 0.5], [0.8, -0.8, 0.5], [0.8, 0.8, 0.5], [-0.8, 0.8, 0.5], [0, 0, 1.5]]})");
  const Tracer tracer({{house, Solver::newton}});
  const std::vector<Net>& nets = tracer.surfaces()[0].surface.patches;
  std::mt19937_64 random(31);
  const auto draw = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  const int aimed = static_cast<int>(soaked(400.0, 40'000.0));  // of milliseconds each
  int rays = 0, unlike = 0;
  std::string worst = "none";
  const auto ask = [&](const Ray& ray) {
    ++rays;
    const Hit closest = tracer.closest(ray);
    const std::vector<Hit> all = tracer.all(ray);
    const bool same = !all.empty() && closest.t == all[0].t && closest.patch == all[0].patch &&
                      closest.u == all[0].u && closest.v == all[0].v;
    if (same) return;
    ++unlike;
    worst = fmt::format(
        "{} hits, patch {} or {}, o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g})",
        all.size(), closest.patch, all.empty() ? -1 : all[0].patch, ray.origin.x, ray.origin.y, ray.origin.z,
        ray.direction.x, ray.direction.y, ray.direction.z);
  };
  for (int k = 0; rays < aimed && k < 100 * aimed; ++k) {
    const Net& net = nets[random() % nets.size()];
    const auto point = [&](double s) {
      return k % 3 == 0   ? net_point(net, 0.0, s)
             : k % 3 == 1 ? net_point(net, s, 0.0)
                          : net_point(net, s, 1.0 - s);
    };
    const dvec3 a = point(draw()), b = point(draw());
    // Of points nearer each other than leaves are wide, both are one leaf's to find.
    if (std::fabs(a.z - b.z) < 1e-15 && glm::distance(a, b) > 0.2) ask({a + 3.0 * (a - b), b - a});
  }
  // All along a straight side, from whose every leaf the vertex could be told.
  ask({{-2.6411758125663818, -2.6411758125663831, 0.53380649695891613},
       {0.053945699245240598, 0.053945699245245969, -2.9425746734487034e-16}});
  ask({{2.0236560166084754, 2.0236560166084754, 0.53380649695890503},
       {-0.61343645852293427, -0.61343645852293438, 1.6882428298634561e-16}});
  ask({{2.8472564029973282, -2.8472564029973273, 0.53380649695890503},
       {-0.2685253257768388, 0.26852532577683863, 1.1102230246251565e-16}});
  INFO(unlike << " of " << rays << " rays; the last: " << worst);
  CHECK(unlike == 0);
  CHECK(rays == aimed + 3);
}

}  // namespace rondure
