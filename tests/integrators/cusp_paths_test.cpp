// Paths between mirrors that touch, or nearly: two spheres side by side, or one inside the other. They bounce
// towards the point of contact, where the gap is less than any rounding.

#include <fmt/format.h>

#include <array>
#include <random>

#include "renderer/intersect/local_ray.h"
#include "renderer/shading/direct_light.h"
#include "tests/catch.h"
#include "tests/integrators/walk_paths.h"
#include "tests/intersect/closed_models.h"
#include "tests/intersect/ellipsoid_chord.h"
#include "tests/intersect/random_direction.h"
#include "tests/render/staged_scene.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

constexpr double u = 0x1p-53;
constexpr int max_depth = 64;

// Spheres of radii 7 a and 7 b about the points axis times a and b to either side of the origin, or to one:
// the axis is of length 7, so that doubles hold all of it and they touch there. Then moved apart.
struct Pair {
  const char* name;
  const char* first;
  const char* second;
  const char* solver;
  double a = 1.0, b = 1.0;
  bool nested = false;  // the first inside the second
  double gap = 0.0;     // in radii of the first
  dvec3 axis{7.0, 0.0, 0.0}, origin{0.0};
  double share = 1.0;  // of the paths

  dvec3 center(int k) const {
    if (k == 0) return origin - a * axis;
    return origin + (nested ? -b : b) * axis + gap * a * axis;
  }
  double radius(int k) const { return 7.0 * (k == 0 ? a : b); }
};

struct Tally {
  long paths = 0, bounces = 0, contacts = 0, unfinished = 0, longest = 0;
  long wrong_sides = 0, self_hits = 0, wrong_walls = 0, wrong_light = 0;
  WorstCase t, way, depth;
  std::string first = "none";

  void merge(const Tally& o) {
    paths += o.paths, bounces += o.bounces, contacts += o.contacts, unfinished += o.unfinished;
    longest = std::max(longest, o.longest);
    if (wrong() == 0) first = o.first;
    wrong_sides += o.wrong_sides, self_hits += o.self_hits, wrong_walls += o.wrong_walls,
        wrong_light += o.wrong_light;
    t.merge(o.t), way.merge(o.way), depth.merge(o.depth);
  }
  long wrong() const { return wrong_sides + self_hits + wrong_walls + wrong_light; }
};

std::string text_of(const Ray& ray) {
  return fmt::format("o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g})", ray.origin.x,
                     ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z);
}

std::string scene_of(const Pair& pair) {
  std::string objects;
  for (int k = 0; k < 2; ++k) {
    const dvec3 c = pair.center(k);
    objects += fmt::format(
        R"({}{{ {}, "solver": "{}", "material": "mirror", "radius": {}, "center": [{:.17g}, {:.17g}, {:.17g}] }})",
        k > 0 ? ", " : "", k == 0 ? pair.first : pair.second, pair.solver, pair.radius(k), c.x, c.y, c.z);
  }
  return fmt::format(
      R"({{ "integrator": {{ "type": "path", "max_depth": {0}, "min_depth": {0} }},
  "materials": {{ "mirror": {{ "type": "mirror", "reflectance": 0.5 }} }}, "lights": [ {{ "type": "constant" }} ],
  "objects": [ {1} ] }})",
      max_depth, objects);
}

struct Wall {
  EllipsoidIn<long double> exact;  // a sphere: to some 2^-63 radii, `rounding_` being 2^-51 and more
  double radius;
  bool around;  // paths are inside
};

class Walk {
 public:
  Walk(const Pair& pair, const StagedScene& scene) : pair_(pair), scene_(scene) {
    for (int k = 0; k < 2; ++k) {
      const Surface& surface = scene.tracer.surfaces()[static_cast<std::size_t>(k)].surface;
      const double r = pair.radius(k);
      const double deviation = surface.ellipsoid ? 8.0 * u * r : tangency_band(surface, r);
      walls_.push_back({EllipsoidIn<long double>(dmat3(r), pair.center(k)), r, pair.nested && k == 1});
      rounding_ += 2.0 * deviation + 4.0 * u * (largest(pair.center(k)) + r);
    }
  }

  void walk(std::uint64_t seed, std::uint32_t index, Tally& tally) const {
    std::mt19937_64 random(seed * 1'000'003u + index);
    const Ray camera = aim(random);
    Sampler sampler(seed, 0, 0, index);
    const World& world = scene_.world;
    Ray ray = camera;
    const Hit seen = scene_.tracer.closest(ray);
    Hit hit = seen;
    PassedWalls passed;
    double light = 0.0, throughput = 1.0;
    const long wrong_before = tally.wrong();
    ++tally.paths;
    int depth = 0;
    for (;; ++depth) {
      if (!ends_right(ray, hit, tally)) return;
      light += throughput * found_light(world, ray, hit, nullptr).x;
      if (!hit || depth == max_depth) break;
      sampler.start_block(depth + 1);
      const Bounce here = bounce(world, world.material(hit), hit, passed, -ray.direction, sampler);
      // What of the direction lies along the wall stays; and it is a unit.
      const dvec3 d = here.scattered->direction, change = glm::cross(d - ray.direction, hit.normal);
      tally.way.add(std::max(largest(change), std::fabs(glm::length(d) - 1.0)), 16.0 * u,
                    [&] { return text_of(ray); });
      throughput *= here.scattered->weight.x;
      ray = spawn(hit, d, passed);
      hit = scene_.tracer.closest(ray);
      passed.arrive(ray, hit);
    }
    tally.bounces += depth, tally.longest = std::max<long>(tally.longest, depth);
    if (tally.wrong() != wrong_before) return;
    if (hit) ++tally.unfinished;
    // Half the light goes at each bounce, exactly.
    if ((hit ? throughput : light) != std::ldexp(1.0, -depth))
      note(++tally.wrong_light, "a loss of light", camera, tally);
    if (index % 16 != 0) return;
    Sampler again(seed, 0, 0, index);
    if (scene_.scene.integrator->radiance(world, camera, seen, again) != dvec3(light))
      note(++tally.wrong_light, "another radiance", camera, tally);
  }

 private:
  const Pair& pair_;
  const StagedScene& scene_;
  std::vector<Wall> walls_;
  // How far a vertex may be from its wall, and both walls from their spheres.
  double rounding_ = 0.0;

  void note(long, const char* what, const Ray& ray, Tally& tally) const {
    if (tally.wrong() == 1) tally.first = fmt::format("{}, {}: {}", pair_.name, what, text_of(ray));
  }

  // From the gap some way off, towards the contact or past it by 10^-1 to 10^-17 radii.
  Ray aim(std::mt19937_64& random) const {
    const auto draw = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
    const auto sign = [&] { return draw() < 0.5 ? -1.0 : 1.0; };
    const dvec3 axis = pair_.axis / 7.0;
    const dvec3 along = glm::normalize(glm::cross(axis, random_direction(random)));
    const dvec3 across = glm::cross(axis, along);
    const double r = pair_.radius(0), gap = pair_.gap * r;
    // The depth of a sphere's surface below its tangent plane.
    const auto sag = [&](int k, double x) {
      const double radius = pair_.radius(k);
      return x * x / (radius + std::sqrt(radius * radius - x * x));
    };
    const auto height = [&](double x) {  // somewhere between the walls
      const double low = -sag(0, x), high = gap + (pair_.nested ? -sag(1, x) : sag(1, x));
      return low + (0.01 + 0.98 * draw()) * (high - low);
    };
    const double least = std::sqrt(std::max(0.0, -1.5 * gap * r));  // overlapping ones leave a ring
    const auto power = [&](double digits) { return r * std::pow(10.0, -1.0 - digits * draw()); };
    // Nested ones start where the gap is more than rounding by far.
    const double narrow = std::sqrt(1e3 * rounding_ * r);
    const double from = pair_.nested ? std::max(power(5.0), narrow) : r * (0.1 + 0.7 * draw());
    const double past = least + power(16.0);
    dvec3 start = pair_.origin + (least + from) * along, target = pair_.origin;
    const double kind = draw();
    if (kind < 0.3) {
      start += height(least + from) * axis;
      target += past * (draw() < 0.5 ? across : along);
      target += height(past) * axis;
    } else if (pair_.nested) {
      // Round the cavity, towards the contact or away.
      start += height(from) * axis;
      target =
          start + sign() * (-along + sign() * 1e-3 * power(8.0) / r * axis) + sign() * power(16.0) * across;
    } else {
      // Next to the plane in which they touch.
      const double low = std::min(power(16.0), 0.9 * std::min(sag(0, from), sag(1, from)));
      start += (0.5 * gap + sign() * low) * axis;
      target += sign() * past * across + (0.5 * gap + sign() * power(16.0)) * axis;
    }
    return {start, glm::normalize(target - start)};
  }

  // Whether the ray ends where the nearest wall is, and passes none.
  bool ends_right(const Ray& ray, const Hit& hit, Tally& tally) const {
    double expected = INFINITY, allowed = 0.0;
    int wall = -1;
    bool sure = true;
    const double end = hit ? hit.t : 1e3 * pair_.radius(1);
    for (int k = 0; k < 2; ++k) {
      const Wall& w = walls_[static_cast<std::size_t>(k)];
      const bool own = ray.start.surface == k;
      // Into the one or out of the other by more than the rounding of walls and start.
      const EllipsoidIn<long double>::Line line = w.exact.line(ray.origin, ray.direction);
      const double below = w.around ? -std::min(line.depth_at(0.0), line.depth_at(end)) : line.depth(end);
      tally.depth.add(below * w.radius, rounding_, [&] {
        return fmt::format("{}, wall {} of a ray from {} to t = {}: {}", pair_.name, k, ray.start.surface,
                           end, text_of(ray));
      });
      if (own && !w.around) continue;  // convex, and the ray leaves it
      const EllipsoidChord c = line.chord();
      const int which = w.around ? 1 : 0;
      const double touching = std::sqrt(2.0 * rounding_ * w.radius);
      if (std::fabs(c.clearance) * w.radius <= rounding_) sure = false;
      if (!(c.clearance < 0.0)) continue;
      // Where it starts on the wall by rounding, that has been checked above.
      const double shift = 2.0 * std::min(rounding_ / c.cosine[which], touching);
      if (!own && std::fabs(c.t[which]) <= shift) sure = false;
      if (c.t[which] <= 0.0 || c.t[which] > expected) continue;
      expected = c.t[which], allowed = shift + 4.0 * u * std::fabs(c.t[1]), wall = k;
    }
    if (!sure) return ++tally.contacts, true;
    if (hit.surface != wall) {
      // The start may lie within its own wall by rounding, and graze it.
      const double grazing = 2.0 * std::sqrt(2.0 * rounding_ * pair_.radius(ray.start.surface == 0 ? 0 : 1));
      if (hit && hit.surface == ray.start.surface && hit.t <= grazing) return ++tally.contacts, true;
      note(++(hit && hit.surface == ray.start.surface ? tally.self_hits : tally.wrong_walls), "a wrong wall",
           ray, tally);
      return false;
    }
    if (!hit) return true;
    if ((glm::dot(hit.normal, ray.direction) > 0.0) != walls_[static_cast<std::size_t>(wall)].around)
      return note(++tally.wrong_sides, "the wrong side", ray, tally), false;
    tally.t.add(std::fabs(hit.t - expected), hit.t_error + allowed,
                [&] { return fmt::format("{}: {} for {}, {}", pair_.name, hit.t, expected, text_of(ray)); });
    return true;
  }
};

std::vector<Pair> pairs() {
  const char* const sphere = R"("type": "sphere")";
  const char* const cube = R"("type": "sphere_tiling", "topology": "cube")";
  const char* const hemispheres = R"("type": "sphere_tiling", "topology": "hemispheres")";
  const char* const octants = R"("type": "sphere_octant")";
  const dvec3 x(7.0, 0.0, 0.0), skew(2.0, 3.0, 6.0), far(1000.0, -2000.0, 512.0);
  std::vector<Pair> out = {
      {"spheres", sphere, sphere, "auto"},
      {"cubes", cube, cube, "newton"},
      {"cubes, skew", cube, cube, "quadric", 1.0, 2.0, false, 0.0, skew},
      {"octants, at a corner", octants, octants, "newton"},
      // At a singular corner, where a ray that clings to the wall takes milliseconds.
      {"octants and hemispheres", octants, hemispheres, "quadric", 0.5, 4.0, false, 0.0, x, dvec3(0.0), 0.05},
      {"hemispheres far away", hemispheres, hemispheres, "newton", 1.0, 1.0, false, 0.0, skew, far},
      {"sphere in a cube", sphere, cube, "newton", 1.0, 2.0, true, 0.0, x, dvec3(0.0), 0.5},
      {"cube in octants", cube, octants, "quadric", 0.5, 2.0, true, 0.0, skew, dvec3(0.0), 0.5},
      {"octants in hemispheres", octants, hemispheres, "newton", 1.0, 1.5, true, 0.0, skew, far, 0.5},
  };
  for (int k = 4; k <= 16; k += 2) {
    const double gap = std::pow(10.0, -k);
    const char *const one = k % 4 == 0 ? "newton" : "quadric", *const other =
                                                                   k % 4 == 0 ? "quadric" : "newton";
    out.push_back({"cubes apart", cube, cube, one, 1.0, 2.0, false, gap, skew});
    out.push_back({"cubes overlapping", cube, cube, other, 1.0, 1.0, false, -gap});
  }
  return out;
}

TEST_CASE("Paths between mirrors that touch pass neither", "[once][integrators]") {
  const double wanted = wanted_paths(1e4);
  const std::vector<Pair> all = pairs();
  double shares = 0.0;
  for (const Pair& pair : all) shares += pair.share;
  Tally tally;
  std::uint64_t seed = first_seed();
  for (const Pair& pair : all) {
    const StagedScene scene(scene_of(pair));
    const Walk walk(pair, scene);
    const auto paths = static_cast<std::uint32_t>(wanted * pair.share / shares);
    tally.merge(walk_paths<Tally>(walk, seed++, paths, 50));
  }
  WARN(fmt::format(
      "{} paths, {} bounces, of which {} within rounding of the other wall; {} paths not out after {}",
      tally.paths, tally.bounces, tally.contacts, tally.unfinished, max_depth));
  INFO(fmt::format("{} self-hits, {} wrong walls, {} wrong sides, {} wrong radiances; the first: {}",
                   tally.self_hits, tally.wrong_walls, tally.wrong_sides, tally.wrong_light, tally.first));
  INFO("depth: " << tally.depth.text());
  INFO("t: " << tally.t.text());
  INFO("directions: " << tally.way.text());
  CHECK(tally.wrong() == 0);
  CHECK(tally.depth.failures() == 0);
  CHECK(tally.t.failures() == 0);
  CHECK(tally.way.failures() == 0);
  CHECK(tally.bounces > 20 * tally.paths);
  CHECK(tally.contacts > tally.bounces / 100);
  CHECK(tally.unfinished < tally.paths * 3 / 4);
}

}  // namespace
}  // namespace rondure
