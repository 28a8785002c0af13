// Every exact family against the analytic sphere: which rays hit, how often, where.

#include <fmt/core.h>

#include <random>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/local_ray.h"
#include "renderer/intersect/solve_leaf.h"
#include "renderer/intersect/tracer.h"
#include "tests/catch.h"
#include "tests/intersect/placed.h"
#include "tests/intersect/random_direction.h"
#include "tests/intersect/sphere_reference.h"
#include "tests/soak.h"
#include "tests/surfaces/build_family.h"
#include "tests/tallied.h"
#include "tests/worst_case.h"

using namespace rondure;

namespace {

constexpr double ulp = 0x1p-52;

// In which rays at the sphere's rim may go either way. The solvers' residual bound is 12 roundoffs of |S| +
// |base| w, which is 2.4 w R at most on these nets (hull of a leaf), hence 12 * 2.4 / 2 ulps of R, and 1.5
// for the sphere's own distance from the rounded nets.
constexpr double band = 16.0 * ulp;
constexpr double position_tolerance = 8.0 * ulp;
// t is wrong by what the position is wrong, divided by the cosine of incidence, and by its own rounding.
constexpr double t_tolerance = 8.0 * ulp;

struct Tally {
  WorstCase position, t;
  long rays = 0, hits = 0, in_band = 0, wrong_count = 0, disagreements = 0;
  std::size_t exhausted = 0;  // searches that gave up
  double worst_clearance = 0.0;
  std::string worst_miss = "none";

  void merge(const Tally& o) {
    rays += o.rays, hits += o.hits, in_band += o.in_band, wrong_count += o.wrong_count,
        disagreements += o.disagreements, exhausted += o.exhausted;
    if (o.worst_clearance > worst_clearance) worst_clearance = o.worst_clearance, worst_miss = o.worst_miss;
    position.merge(o.position);
    t.merge(o.t);
  }
};

struct Case {
  const char* name;
  Surface surface;
  Solver solver;
  double radius;
  dvec3 center;
};

enum class Kind {
  outside,
  inside,
  far_away,
  tangential,
  edge,
  corner,
  singular,
  leaf_corner,
  from_far_at_edge,
  count
};
constexpr long random_kinds = 3;  // the first; the others are aimed where it hurts

// How many rays of either sort.
struct Load {
  long random, aimed;
};

// A point of a patch's boundary, or a corner of it, in the surface's frame.
dvec3 boundary_point(const Surface& surface, std::mt19937_64& random, bool corner) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const std::size_t patch = std::uniform_int_distribution<std::size_t>(0, surface.patches.size() - 1)(random);
  const double along = corner ? std::floor(2.0 * uniform(random)) : uniform(random),
               across = uniform(random) < 0.5 ? 0.0 : 1.0;
  const bool swap = uniform(random) < 0.5;
  return net_point(surface.patches[patch], swap ? across : along, swap ? along : across);
}

// Every draw is a statement of its own: within an expression their order would be the compiler's choice.
Ray make_ray(const Case& c, Kind kind, std::mt19937_64& random, bool& starts_inside) {
  const auto draw = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  const dvec3 d = random_direction(random), across = random_direction(random);
  const dvec3 side = glm::normalize(glm::cross(d, across));
  const double a = draw(), b = draw(), e = draw();
  Ray ray;
  ray.direction = d * std::exp2(std::floor(20.0 * e) - 10.0);  // directions need not be unit vectors
  starts_inside = false;
  const auto set_origin = [&](const dvec3& unit) { ray.origin = c.center + c.radius * unit; };
  const auto aim = [&](double distance, const dvec3& target) {
    set_origin(d * distance);
    ray.direction = (c.center + target - ray.origin) * (0.5 + e);
  };
  const auto aim_from_either_side = [&](const dvec3& target) {
    starts_inside = a < 0.5;
    aim(starts_inside ? 0.9 * b : 1.1 + 3.0 * b, target);
  };
  switch (kind) {
    case Kind::outside:
      set_origin(side * 1.2 * std::sqrt(a) - d * (1.5 + 9.0 * b));
      break;
    case Kind::inside:
      set_origin(across * 0.99 * std::cbrt(a)), starts_inside = true;
      break;
    case Kind::far_away:
      set_origin(side * 1.2 * std::sqrt(a) - d * 1e6);
      break;
    case Kind::tangential: {
      const double off = std::pow(10.0, -1.0 - 15.0 * a);
      set_origin(side * (b < 0.5 ? 1.0 - off : 1.0 + off) - d * (1.5 + draw()));
      break;
    }
    case Kind::edge:
    case Kind::corner:
      aim_from_either_side(boundary_point(c.surface, random, kind == Kind::corner));
      break;
    case Kind::singular: {
      // Towards the corners and poles where tangents are parallel or vanish, missing them by 10^-1 to 10^-17
      // of the radius.
      const dvec3 near = across * c.radius * std::pow(10.0, -1.0 - 16.0 * draw());
      aim_from_either_side(boundary_point(c.surface, random, true) + near);
      break;
    }
    case Kind::leaf_corner: {
      // Towards parameters where leaves meet, missing them by 10^-8 to 10^-17 of the radius.
      std::uniform_int_distribution<std::size_t> any_patch(0, c.surface.patches.size() - 1);
      const std::size_t patch = any_patch(random);
      const double u = std::floor(17.0 * draw()) / 16.0, v = std::floor(17.0 * draw()) / 16.0;
      const dvec3 near = across * c.radius * std::pow(10.0, -8.0 - 9.0 * draw());
      aim_from_either_side(net_point(c.surface.patches[patch], u, v) + near);
      break;
    }
    case Kind::from_far_at_edge:
      aim(1e6, boundary_point(c.surface, random, a < 0.5));
      break;
    case Kind::count:
      break;
  }
  return ray;
}

// `compare`: also whether `closest` and `occluded` tell what `all` does.
void check_ray(const Case& c, const Tracer& tracer, Kind kind, bool compare, std::mt19937_64& random,
               Tally& tally) {
  bool inside = false;
  const Ray ray = make_ray(c, kind, random, inside);
  const SphereReference exact = sphere_reference(ray.origin, ray.direction, c.center, c.radius);
  const std::vector<Hit> all = tracer.all(ray);
  ++tally.rays;
  tally.hits += static_cast<long>(all.size());
  const auto describe = [&] {
    return fmt::format(
        "{}, kind {}: o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g}), clearance {:.3g} "
        "ulp, {} hits",
        c.name, static_cast<int>(kind), ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
        ray.direction.y, ray.direction.z, exact.clearance / ulp, all.size());
  };

  if (compare) {
    const Hit closest = tracer.closest(ray);
    const bool same_first =
        all.empty() ? !closest
                    : (closest && closest.t == all.front().t && closest.patch == all.front().patch);
    if (!same_first || tracer.occluded(ray) != static_cast<bool>(closest)) ++tally.disagreements;
  }

  // The centre's own rounding moves a sphere at `center` by up to an ulp of it.
  const double shift = 2.0 * ulp * largest(c.center) / c.radius;
  for (const Hit& hit : all) {
    const double off = std::fabs(glm::length(hit.point - c.center) / c.radius - 1.0);
    tally.position.add(off, position_tolerance + shift, describe);
  }

  const std::size_t expected = exact.clearance < 0.0 ? (inside ? 1 : 2) : 0;
  if (std::fabs(exact.clearance) <= band + shift) {
    ++tally.in_band;
    return;
  }
  if (all.size() != expected) {
    ++tally.wrong_count;
    if (std::fabs(exact.clearance) > tally.worst_clearance)
      tally.worst_clearance = std::fabs(exact.clearance), tally.worst_miss = describe();
    return;
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double reference = exact.t[inside ? 1 : k];
    const double kappa = c.radius / (glm::length(ray.direction) * exact.cosine);
    const double tolerance = t_tolerance * (std::fabs(reference) + kappa * (1.0 + shift / ulp));
    tally.t.add(std::fabs(all[k].t - reference), tolerance, describe);
  }
}

constexpr long block = 2000;  // rays of one seed

Tally check_case(const Case& c, Load load) {
  const Tracer tracer({{c.surface, c.solver}});
  const long random_blocks = load.random / block, blocks = random_blocks + load.aimed / block;
  return tallied<Tally>(static_cast<std::size_t>(blocks), [&](std::size_t b, Tally& tally) {
    std::mt19937_64 random(b + 1);
    const bool aimed = static_cast<long>(b) >= random_blocks;
    const std::size_t given_up = thread_counts().search.exhausted;
    for (long k = 0; k < block; ++k) {
      const long kind =
          aimed ? random_kinds + k % (static_cast<long>(Kind::count) - random_kinds) : k % random_kinds;
      check_ray(c, tracer, static_cast<Kind>(kind), aimed || k % 8 == 0, random, tally);
    }
    tally.exhausted += thread_counts().search.exhausted - given_up;
  });
}

void require_clean(const Tally& tally, const std::string& what) {
  WARN(
      fmt::format("{}: {} rays, {} hits; within {:.0f} ulp of tangency {:.3g}% of the rays; worst | |p-c|/R "
                  "- 1 | {:.2g} ulp; worst t "
                  "{:.2g} of its tolerance",
                  what, tally.rays, tally.hits, band / ulp,
                  100.0 * static_cast<double>(tally.in_band) / static_cast<double>(tally.rays),
                  tally.position.error() / ulp, tally.t.ratio()));
  INFO("wrong count of hits: " << tally.wrong_count << "; the furthest from tangency: " << tally.worst_miss);
  INFO("position: " << tally.position.text());
  INFO("t: " << tally.t.text());
  CHECK(tally.wrong_count == 0);
  CHECK(tally.disagreements == 0);
  CHECK(tally.exhausted == 0);
  CHECK(tally.position.failures() == 0);
  CHECK(tally.t.failures() == 0);
  // Half of the rays at least hit something: the test has something to say.
  CHECK(tally.hits > tally.rays / 2);
}

// Rays for one of the default run: a hundred in a soak (10^7 random rays at least for each family and
// solver), a twentieth under the sanitizers, which are that much slower.
double effort() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return 0.05;
#else
  return soaked(1.0, 100.0);
#endif
}

Load load(double random, double aimed) {
  // Whole blocks: a small part of a small load is not nothing.
  const auto rays = [](double count) {
    return block * static_cast<long>(std::ceil(count * effort() / block));
  };
  return {rays(random), rays(aimed)};
}

std::vector<std::pair<const char*, Surface>> closed_families() {
  return {{"cube", build_family(R"({"type": "sphere_tiling", "topology": "cube"})")},
          {"hemispheres", build_family(R"({"type": "sphere_tiling", "topology": "hemispheres"})")},
          {"octants", build_family(R"({"type": "sphere_octant"})")}};
}

}  // namespace

TEST_CASE("Newton finds every hit of the analytic sphere on the closed families, and no other", "[hits]") {
  long all_random = 0;
  for (const auto& [name, surface] : closed_families()) {
    const Load unit = load(2'200'000, 72'000), elsewhere = load(200'000, 48'000);
    const long random = unit.random + 6 * elsewhere.random;
    all_random += random;
    CHECK(static_cast<double>(random) >= 3'000'000 * effort());
    Tally tally = check_case({name, surface, Solver::newton, 1.0, dvec3(0.0)}, unit);
    // 10^-4 to 10^4, at the origin and beside it.
    for (const double radius : {1e-4, 0.37, 1e4})
      for (const dvec3& center : {dvec3(0.0), radius * dvec3(3.1, -2.7, 10.3)})
        tally.merge(
            check_case({name, placed(surface, radius, center), Solver::newton, radius, center}, elsewhere));
    require_clean(tally, std::string("newton, ") + name);
  }
  CHECK(static_cast<double>(all_random) >= 10'000'000 * effort());
}

TEST_CASE("Clipping alone finds the same", "[hits]") {
  for (const auto& [name, surface] : closed_families())
    require_clean(check_case({name, surface, Solver::clipping, 1.0, dvec3(0.0)}, load(100'000, 48'000)),
                  std::string("clipping, ") + name);
}

TEST_CASE("The quadric solver finds the same", "[hits]") {
  for (const auto& [name, surface] : closed_families()) {
    Tally tally = check_case({name, surface, Solver::quadric, 1.0, dvec3(0.0)}, load(600'000, 72'000));
    for (const double radius : {1e-4, 0.37, 1e4})
      for (const dvec3& center : {dvec3(0.0), radius * dvec3(3.1, -2.7, 10.3)})
        tally.merge(check_case({name, placed(surface, radius, center), Solver::quadric, radius, center},
                               load(60'000, 24'000)));
    require_clean(tally, std::string("quadric, ") + name);
    // Half of what the others are allowed: 4 ulps about the origin, and elsewhere as many more as the
    // centre's own rounding makes them.
    CHECK(tally.position.ratio() <= 0.5);
  }
}

TEST_CASE("Every other tiling is met as these are", "[hits]") {
  const char* const parameters[] = {R"("topology": "cube_2_4")",
                                    R"("topology": "icosahedron_pairs")",
                                    R"("topology": "icosahedron_pairs", "corner_weights": "unit")",
                                    R"("topology": "octahedron_pairs")",
                                    R"("topology": "tetrahedron_quads")",
                                    R"("topology": "octahedron_quads", "middle_weight": 30)",
                                    R"("topology": "icosahedron_pairs", "middle_weight": 0.001)",
                                    R"("topology": "icosahedron_quads")",
                                    R"("topology": "rhombicuboctahedron", "reading": 42)",
                                    R"("topology": "rhombicuboctahedron", "corner_weights": "unit")"};
  Tally newton, clipping, quadric;
  for (const char* which : parameters) {
    const Surface surface = build_family(fmt::format(R"({{"type": "sphere_tiling", {}}})", which));
    const dvec3 center = 0.37 * dvec3(3.1, -2.7, 10.3);
    newton.merge(check_case({which, surface, Solver::newton, 1.0, dvec3(0.0)}, load(16'000, 20'000)));
    newton.merge(
        check_case({which, placed(surface, 0.37, center), Solver::newton, 0.37, center}, load(2'000, 4'000)));
    clipping.merge(check_case({which, surface, Solver::clipping, 1.0, dvec3(0.0)}, load(2'000, 4'000)));
    quadric.merge(check_case({which, surface, Solver::quadric, 1.0, dvec3(0.0)}, load(16'000, 20'000)));
    quadric.merge(check_case({which, placed(surface, 0.37, center), Solver::quadric, 0.37, center},
                             load(2'000, 4'000)));
  }
  require_clean(newton, "newton, other tilings");
  require_clean(clipping, "clipping, other tilings");
  require_clean(quadric, "quadric, other tilings");
}

TEST_CASE("The analytic sphere passes the same test", "[hits]") {
  // Aimed rays need patches: those of the cube stand in.
  const Tracer tracer({{build_family(R"({"type": "sphere"})"), Solver::newton}});
  const Case c{"sphere", closed_families()[0].second, Solver::newton, 1.0, dvec3(0.0)};
  Tally tally;
  std::mt19937_64 random(5);
  for (long k = 0; k < 200'000; ++k)
    check_ray(c, tracer, static_cast<Kind>(k % static_cast<long>(Kind::count)), true, random, tally);
  require_clean(tally, "sphere");
}
