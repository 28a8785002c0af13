#include "tests/bench/scale.h"

#include <fmt/core.h>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <random>

#include "renderer/intersect/tracer.h"
#include "tests/intersect/mapped.h"
#include "tests/intersect/random_direction.h"
#include "tests/surfaces/build_family.h"

namespace rondure::bench {
namespace {

// Of all threads together, their own time: others may be busy.
double seconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// Tilings of which each has its own nets are this many at the most, for their memory.
constexpr int most_distinct = 100'000;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Places of unit spheres, on a grid about the origin.
std::vector<dvec3> grid(int count) {
  const int side = static_cast<int>(std::ceil(std::cbrt(count)));
  std::vector<dvec3> out;
  for (int k = 0; k < count; ++k)
    out.push_back(3.0 * (dvec3(k % side, k / side % side, k / (side * side)) - 0.5 * dvec3(side - 1)));
  return out;
}

// From around the grid to random places of it, in no order.
std::vector<Ray> rays_at(const std::vector<dvec3>& places, int count) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<std::size_t> any(0, places.size() - 1);
  const double far = 2.0 * glm::length(places.front()) + 4.0;
  std::vector<Ray> rays;
  for (int k = 0; k < count; ++k) {
    const double a = normal(random), b = normal(random), c = normal(random), d = normal(random),
                 e = normal(random), f = normal(random);
    const dvec3 origin = far * glm::normalize(dvec3(a, b, c)),
                target = places[any(random)] + 0.5 * dvec3(d, e, f);
    rays.push_back({origin, glm::normalize(target - origin)});
  }
  return rays;
}

// Embree's spheres, one geometry of them all.
class Spheres {
 public:
  explicit Spheres(const std::vector<dvec3>& places)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), places.size()));
    for (const dvec3& p : places) {
      for (int k = 0; k < 3; ++k) *v++ = static_cast<float>(p[k]);
      *v++ = 1.0f;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~Spheres() { rtcReleaseScene(scene_), rtcReleaseDevice(device_); }
  Spheres(const Spheres&) = delete;
  Spheres& operator=(const Spheres&) = delete;

  bool hit(const Ray& ray) const {
    RTCRayHit q{};
    q.ray.org_x = static_cast<float>(ray.origin.x), q.ray.org_y = static_cast<float>(ray.origin.y);
    q.ray.org_z = static_cast<float>(ray.origin.z), q.ray.dir_x = static_cast<float>(ray.direction.x);
    q.ray.dir_y = static_cast<float>(ray.direction.y), q.ray.dir_z = static_cast<float>(ray.direction.z);
    q.ray.tfar = INFINITY, q.ray.mask = ~0u;
    q.hit.geomID = q.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene_, &q);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &q);
#endif
    return q.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

// The tiling at every place; or, `distinct`, as many with nets of their own, each turned.
std::vector<TracedSurface> tilings(const Surface& tiling, const std::vector<dvec3>& places, bool distinct,
                                   Solver solver) {
  std::vector<TracedSurface> out;
  std::mt19937_64 random(5);
  for (std::size_t k = 0; k < places.size(); ++k) {
    Surface surface = tiling;
    surface.origin = places[k];
    if (distinct)
      surface = mapped(std::move(surface),
                       glm::rotate(dmat4(1.0), static_cast<double>(k), random_direction(random)));
    out.push_back({std::move(surface), solver});
  }
  return out;
}

struct Contender {
  std::function<bool(const Ray&)> trace;
  std::vector<double> time = {}, ratio = {};
};

void print_counts(const Surface& tiling, Solver solver, int count, int rounds) {
  const std::vector<dvec3> places = grid(count);
  const std::vector<Ray> rays = rays_at(places, 20'000);
  std::size_t net_bytes = 0;
  for (const Net& net : tiling.patches) net_bytes += sizeof(Net) + points_of(net).size() * sizeof(dvec4);
  const double patches = static_cast<double>(tiling.patches.size()) * count;

  double build[2], bytes[2];
  std::optional<Tracer> tracers[2];
  const int kinds = count <= most_distinct ? 2 : 1;
  for (const bool distinct : {false, true}) {
    if (distinct && kinds == 1) continue;
    std::vector<TracedSurface> surfaces = tilings(tiling, places, distinct, solver);
    build[distinct] = seconds([&] { tracers[distinct].emplace(std::move(surfaces)); });
    bytes[distinct] =
        static_cast<double>(tracers[distinct]->statistics().bytes) - static_cast<double>(net_bytes) * count;
  }
  const Spheres spheres(places);
  std::vector<Contender> contenders = {
      {[&](const Ray& ray) { return spheres.hit(ray); }},
  };
  for (int k = 0; k < kinds; ++k)
    contenders.push_back({[&, k](const Ray& ray) { return static_cast<bool>(tracers[k]->closest(ray)); }});
  std::size_t hits = 0;
  for (int round = 0; round < rounds; ++round)
    for (Contender& c : contenders) {
      const std::clock_t start = std::clock();  // this thread's own: others may be busy
      for (const Ray& ray : rays) hits += c.trace(ray);
      const double time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      c.time.push_back(time / static_cast<double>(rays.size()) * 1e9);
      c.ratio.push_back(contenders[0].time.back() / c.time.back());
    }
  fmt::print("  {:>8} {:>8.0f} |", count, median(contenders[0].time));
  for (std::size_t k = 0; k + 1 < contenders.size(); ++k)
    fmt::print(" {:>8.0f} {:>7.3f}x {:>11.0f} {:>9.0f} |", median(contenders[k + 1].time),
               median(contenders[k + 1].ratio), patches / build[k], bytes[k] / patches);
  fmt::print(" {:.2f}\n",
             static_cast<double>(hits) / static_cast<double>(contenders.size() * rays.size()) / rounds);
}

}  // namespace

void print_scale(int rounds, int most) {
  const Surface cube = build_family(R"({"type": "sphere_tiling", "topology": "cube"})");
  for (const Solver solver : {Solver::quadric, Solver::newton}) {
    fmt::print(
        "\nmany spheres, {}, ns a ray, one thread; patches a second and thread; bytes beyond the nets\n",
        solver == Solver::newton ? "newton" : "quadric");
    fmt::print("  {:>8} {:>8} | {:>8} {:>8} {:>11} {:>9} | {:>8} {:>8} {:>11} {:>9} | hits\n", "", "Embree",
               "tilings,", "", "patches/s", "bytes/", "tilings,", "", "patches/s", "bytes/");
    fmt::print("  {:>8} {:>8} | {:>8} {:>8} {:>11} {:>9} | {:>8} {:>8} {:>11} {:>9} |\n", "objects",
               "spheres", "shared", "ratio", "built", "patch", "distinct", "ratio", "built", "patch");
    for (int count = 100; count <= most; count *= 10) print_counts(cube, solver, count, rounds);
  }
}

}  // namespace rondure::bench
