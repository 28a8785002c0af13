// Paths inside glass whose walls are tiled by patches, by the renderer's own scattering: every chord ends
// where the ellipsoid ends it, no path loses its side, and none its light.

#include <fmt/format.h>

#include <array>
#include <memory>
#include <random>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/local_ray.h"
#include "renderer/shading/direct_light.h"
#include "renderer/shading/fresnel.h"
#include "tests/catch.h"
#include "tests/integrators/glass_bodies.h"
#include "tests/integrators/transmission.h"
#include "tests/integrators/walk_paths.h"
#include "tests/intersect/closed_models.h"
#include "tests/intersect/ellipsoid_chord.h"
#include "tests/intersect/random_direction.h"
#include "tests/render/staged_scene.h"
#include "tests/worst_case.h"

namespace rondure {
namespace {

constexpr double u = 0x1p-53;
constexpr int max_depth = 24;

enum class Start { outside, touching, inside, along_wall, seam_inside, seam_outside, critical, count };
constexpr auto starts = static_cast<std::size_t>(Start::count);
constexpr const char* start_names[starts] = {"outside",       "touching",       "inside",  "along the wall",
                                             "inside, seams", "outside, seams", "critical"};

struct Tally {
  std::array<long, starts> paths{};
  long chords = 0, reflections = 0, refractions = 0, total = 0, kept = 0;
  long in_band = 0, spawned_in_band = 0;  // camera rays, and those that left a wall
  // What must not be.
  long escapes = 0, self_hits = 0, wrong_walls = 0, wrong_sides = 0, wrong_choices = 0, other_light = 0;
  WorstCase t, fresnel, way, light;
  std::string first = "none";

  void merge(const Tally& o) {
    for (std::size_t k = 0; k < starts; ++k) paths[k] += o.paths[k];
    chords += o.chords, reflections += o.reflections, refractions += o.refractions, total += o.total;
    kept += o.kept, in_band += o.in_band, spawned_in_band += o.spawned_in_band;
    if (wrong() == 0) first = o.first;
    escapes += o.escapes, self_hits += o.self_hits, wrong_walls += o.wrong_walls;
    wrong_sides += o.wrong_sides, wrong_choices += o.wrong_choices, other_light += o.other_light;
    t.merge(o.t), fresnel.merge(o.fresnel), way.merge(o.way), light.merge(o.light);
  }
  long wrong() const { return escapes + self_hits + wrong_walls + wrong_sides + wrong_choices + other_light; }
};

std::string text_of(const Ray& ray) {
  return fmt::format("o = ({:.17g}, {:.17g}, {:.17g}), d = ({:.17g}, {:.17g}, {:.17g})", ray.origin.x,
                     ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z);
}

class Walk {
 public:
  Walk(const GlassBody& body, const StagedScene& scene)
      : body_(body),
        scene_(scene),
        surface_(scene.tracer.surfaces()[0].surface),
        exact_(body.linear, body.center),
        deviation_(tangency_band(surface_, exact_.extent())),
        band_(deviation_ * exact_.shrinking()),
        least_depth_(4.0 * (deviation_ + 2.0 * u * largest(body.center)) * exact_.shrinking()) {}

  void walk(std::uint64_t seed, std::uint32_t index, Tally& tally) const {
    std::mt19937_64 random(seed * 1'000'003u + index);
    const auto which = static_cast<Start>(index % starts);
    bool inside = false;
    const Ray camera = aim(which, random, inside);
    const bool started_inside = inside;
    const World& world = scene_.world;
    Sampler sampler(seed, 0, 0, index);

    double light = 0.0, throughput = 1.0;
    int refractions = 0;
    Ray ray = camera;
    const Hit seen = scene_.tracer.closest(ray);
    Hit hit = seen;
    PassedWalls passed;
    const long wrong_before = tally.wrong();
    ++tally.paths[static_cast<std::size_t>(which)];
    for (int depth = 0;; ++depth) {
      if (!ends_right(ray, hit, inside, tally)) return;
      light += throughput * found_light(world, ray, hit, nullptr).x;
      if (!hit || depth == max_depth) break;
      sampler.start_block(depth + 1);
      Sampler same = sampler;
      const Bounce here = bounce(world, world.material(hit), hit, passed, -ray.direction, sampler);
      if (!here.scattered) {
        note(++tally.wrong_choices, "light absorbed", ray, tally);
        return;
      }
      same.next_1d();
      const ScatterSample& s = *here.scattered;
      const bool crossed = check_scattering(ray, hit, s, same.next_1d(), inside, tally);
      if (crossed) inside = !inside, ++refractions;
      throughput *= s.weight.x;
      ray = spawn(hit, s.direction, passed);
      hit = scene_.tracer.closest(ray);
      passed.arrive(ray, hit);
    }
    if (tally.wrong() != wrong_before) return;
    // Outside all light is 1; within glass, of index n, the same light has the radiance n^2. A refraction
    // rounds at most five times: 1 / ior, its square twice over, the quotient, the product with the
    // throughput.
    const double n2 = body_.ior * body_.ior;
    const double sent = hit ? throughput * (inside ? n2 : 1.0) : light, expected = started_inside ? n2 : 1.0;
    tally.light.add(std::fabs(sent / expected - 1.0), (5.0 * refractions + 4.0) * u,
                    [&] { return fmt::format("{}: {}", body_.name, text_of(camera)); });
    tally.kept += static_cast<bool>(hit);
    if (index % 16 != 0) return;
    // And the integrator's own sum is this one's, to the last bit.
    Sampler again(seed, 0, 0, index);
    const dvec3 radiance = scene_.scene.integrator->radiance(world, camera, seen, again);
    if (radiance != dvec3(light)) note(++tally.other_light, "another radiance", camera, tally);
  }

 private:
  const GlassBody& body_;
  const StagedScene& scene_;
  const Surface& surface_;
  const EllipsoidReference exact_;
  // How far from the ellipsoid rounding may put the nets: no farther than from touching it a ray may go
  // either way; that in the unit sphere's space; and how deep a start must be to be inside for sure.
  const double deviation_, band_, least_depth_;

  void note(long, const char* what, const Ray& ray, Tally& tally) const {
    if (tally.wrong() == 1) tally.first = fmt::format("{}, {}: {}", body_.name, what, text_of(ray));
  }

  dvec3 world(const dvec3& on_unit_sphere) const { return body_.center + body_.linear * on_unit_sphere; }

  Ray aim(Start which, std::mt19937_64& random, bool& inside) const {
    const auto draw = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
    const auto small = [&](double least) { return std::pow(10.0, -1.0 - (least - 1.0) * draw()); };
    const dvec3 d = random_direction(random);
    const dvec3 side = glm::normalize(glm::cross(d, random_direction(random)));
    const auto towards = [&](const dvec3& from, const dvec3& target) {
      return Ray{from, glm::normalize(target - from)};
    };
    const double back = 1.5 + 3.0 * draw();
    inside = which == Start::inside || which == Start::along_wall || which == Start::seam_inside;
    const auto from_outside = [&](double impact) {
      return towards(world(impact * side - back * d), world(impact * side));
    };
    switch (which) {
      case Start::outside:
        return from_outside(std::sqrt(draw()));
      case Start::touching:
        return from_outside(1.0 - small(14.0));
      case Start::inside:
        return {world(0.999 * std::cbrt(draw()) * d), glm::normalize(body_.linear * side)};
      case Start::along_wall:
        // Round the wall by total reflection, from as near as is surely inside; or out, if the light can.
        return {world((1.0 - small(14.0) - least_depth_) * d), glm::normalize(body_.linear * side)};
      case Start::critical: {
        // At an impact at which the angle within is the critical one, and beside it.
        const double exact = std::min(body_.ior, 1.0 / body_.ior),
                     impact = std::min(exact * (1.0 + (draw() < 0.5 ? -1.0 : 1.0) * small(16.0)), 0.999);
        if (body_.ior < 1.0) return from_outside(impact);
        inside = true;
        const double along = (2.0 * draw() - 1.0) * 0.9 * std::sqrt(1.0 - impact * impact);
        return {world(impact * side + along * d), glm::normalize(body_.linear * d)};
      }
      default: {
        const auto any = std::uniform_int_distribution<std::size_t>(0, surface_.patches.size() - 1);
        const Net& net = surface_.patches[std::uniform_int_distribution<std::size_t>(any)(random)];
        const double along = draw() < 0.3 ? std::floor(2.0 * draw()) : draw();
        const double across = std::floor(2.0 * draw());
        dvec2 p = draw() < 0.5 ? dvec2(along, across) : dvec2(across, along);
        if (std::holds_alternative<TriangleNet>(net)) p = p.x + p.y > 1.0 ? dvec2(1.0 - p.x, p.x) : p;
        const dvec3 seam = surface_.origin + net_point(net, p.x, p.y);
        return towards(inside ? world(0.999 * std::cbrt(draw()) * d) : world(back * d), seam);
      }
    }
  }

  // Whether the ray ends where the ellipsoid ends it. `inside`: it starts in the glass.
  bool ends_right(const Ray& ray, const Hit& hit, bool inside, Tally& tally) const {
    const EllipsoidChord c = exact_.chord(ray.origin, ray.direction);
    const bool spawned = ray.start.surface >= 0;
    // Leaving what is convex, or missing it, it meets nothing.
    const bool expected = inside || (!spawned && c.clearance < 0.0);
    tally.chords += inside;
    const bool right_side = !hit || (glm::dot(hit.normal, ray.direction) > 0.0) == inside;
    if (std::fabs(c.clearance) <= band_ && (static_cast<bool>(hit) != expected || !right_side)) {
      // Rounding of the nets is more than the chord is deep: the ray may meet the wall or not, or touch it,
      // entering and leaving at once.
      ++(spawned ? tally.spawned_in_band : tally.in_band);
      return false;
    }
    if (!hit && !expected) return true;
    if (!hit) return note(++tally.escapes, "an escape", ray, tally), false;
    if (!expected) return note(++tally.self_hits, "a self-hit", ray, tally), false;
    const int far = inside ? 1 : 0;
    // The hit's own bound is to the nets, which are within `deviation_` of the ellipsoid.
    const double touching = std::sqrt(2.0 * deviation_ * exact_.extent());
    const double allowed = hit.t_error + 2.0 * std::min(deviation_ / c.cosine[far], touching) +
                           4.0 * u * (std::fabs(c.t[0]) + std::fabs(c.t[1]));
    const double off = std::fabs(hit.t - c.t[far]);
    if (off > allowed && std::fabs(hit.t - c.t[1 - far]) < off) {
      note(++(spawned ? tally.self_hits : tally.wrong_walls), "the wrong wall", ray, tally);
      return false;
    }
    tally.t.add(off, allowed, [&] {
      return fmt::format("{}: {} for {} at cosine {:.3g}, {}", body_.name, hit.t, c.t[far], c.cosine[far],
                         text_of(ray));
    });
    if (!right_side) note(++tally.wrong_sides, "the wrong side", ray, tally);
    return right_side;
  }

  // Whether the light crosses the wall.
  bool check_scattering(const Ray& ray, const Hit& hit, const ScatterSample& s, double lobe, bool inside,
                        Tally& tally) const {
    const dvec3 out = -ray.direction, n = inside ? -hit.normal : hit.normal;
    const double eta = inside ? 1.0 / body_.ior : body_.ior;
    const double cosine = std::min(1.0, glm::dot(n, out));
    const bool crossed = glm::dot(n, s.direction) < 0.0;
    const auto describe = [&] {
      return fmt::format("{}: cosine {:.17g}, eta {}, {}", body_.name, cosine, eta, text_of(ray));
    };
    const Transmission through = transmission(cosine, eta);
    const double reflected = fresnel_dielectric(cosine, eta);
    tally.fresnel.add(std::fabs(reflected + through.share - 1.0), through.error, describe);
    ++(crossed ? tally.refractions : tally.reflections);
    tally.total += !crossed && through.share == 0.0;
    if (std::fabs(lobe - reflected) > through.error && crossed != (lobe > 1.0 - through.share))
      note(++tally.wrong_choices, "reflected for refracted", ray, tally);
    // What of the direction lies along the wall is what came, over eta where it crosses; and it is a unit.
    const dvec3 change = glm::cross(s.direction + (crossed ? out / eta : out), n);
    const double length = glm::length(s.direction);
    tally.way.add(std::max(largest(change), std::fabs(length - 1.0)), 16.0 * u * (1.0 + 1.0 / eta), describe);
    return crossed;
  }
};

TEST_CASE("All light is reflected where it grazes exactly", "[integrators]") {
  for (const double eta : {1.5, 1.0 / 1.5, 2.4}) {
    const Transmission through = transmission(0.0, eta);
    CHECK(through.share == 0.0);
    CHECK(std::fabs(fresnel_dielectric(0.0, eta) + through.share - 1.0) <= through.error);
  }
}

TEST_CASE("Paths in tiled glass keep their side and their light", "[once][integrators]") {
  // In all; a body met by clipping gets a twentieth.
  const double wanted = wanted_paths(1.2e5);
  const std::vector<GlassBody> all = glass_bodies();
  Tally tally;
  std::uint64_t seed = first_seed();
  for (const GlassBody& body : all) {
    const StagedScene scene(scene_of(body, max_depth));
    const Walk walk(body, scene);
    const double share = std::string(body.solver) == "clipping" ? 0.05 : 1.0;
    const auto paths = static_cast<std::uint32_t>(share * wanted / (static_cast<double>(all.size()) - 0.95));
    tally.merge(walk_paths<Tally>(walk, seed++, paths, 500));
  }
  std::string text;
  long paths = 0;
  for (std::size_t k = 0; k < starts; ++k) {
    paths += tally.paths[k];
    text += fmt::format("{}{} {}", k > 0 ? ", " : "", tally.paths[k], start_names[k]);
    CHECK(tally.paths[k] > 0);
  }
  WARN(fmt::format(
      "{} paths ({}), {} chords in the glass, {} reflections ({} of them total), {} refractions, "
      "{} paths kept for {} reflections, {} camera rays and {} others within rounding of touching",
      paths, text, tally.chords, tally.reflections, tally.total, tally.refractions, tally.kept, max_depth,
      tally.in_band, tally.spawned_in_band));
  INFO(fmt::format(
      "{} escapes, {} self-hits, {} wrong walls, {} wrong sides, {} wrong choices, {} radiances that "
      "are not the integrator's; the first: {}",
      tally.escapes, tally.self_hits, tally.wrong_walls, tally.wrong_sides, tally.wrong_choices,
      tally.other_light, tally.first));
  INFO("t: " << tally.t.text());
  INFO("reflectance and transmittance: " << tally.fresnel.text());
  INFO("directions: " << tally.way.text());
  INFO("light: " << tally.light.text());
  CHECK(tally.wrong() == 0);
  CHECK(tally.t.failures() == 0);
  CHECK(tally.fresnel.failures() == 0);
  CHECK(tally.way.failures() == 0);
  CHECK(tally.light.failures() == 0);
  CHECK(tally.in_band < paths / 1000);
  CHECK(tally.spawned_in_band <= paths / 100'000);
  CHECK(tally.total > paths);
  CHECK(tally.refractions > paths / 2);
  CHECK(tally.light.count() > paths * 9 / 10);
}

}  // namespace
}  // namespace rondure
