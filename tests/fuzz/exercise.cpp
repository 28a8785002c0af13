#include "tests/fuzz/exercise.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "renderer/commands/tracer_of.h"
#include "renderer/plugin/builtin.h"
#include "renderer/render/render.h"

namespace rondure {
namespace {

constexpr std::size_t most_patches = 40;

void require(bool good, const char* what) {
  if (!good) throw std::logic_error(what);
}

bool is_finite(const dvec3& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }

// Through the scene, past it, from inside and from far away.
void trace(const Tracer& tracer) {
  const dvec3 center = tracer.bounding_center();
  const double radius = tracer.bounding_radius();
  for (const double distance : {0.0, 3.0, 1e6}) {
    for (const dvec3& toward : {dvec3(0, 0, 1), dvec3(-1, 0, 0), dvec3(0.3, 0.9, -0.4)}) {
      const Ray ray{center - distance * radius * toward, toward};
      const Hit hit = tracer.closest(ray);
      if (hit) check_hit(hit);
      require(tracer.occluded(ray) == static_cast<bool>(hit),
              "a ray is occluded and has no hit, or the reverse");
      for (const Hit& each : tracer.all(ray)) check_hit(each);
    }
  }
}

void render(const Scene& scene, const World& world) {
  Film film = make_film(scene, {});
  RenderOptions options;
  options.threads = 1;
  add_samples(film, 1, scene, world, options);
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      const FilmSample mean = film.mean(x, y);
      const PixelGeometry& at = film.geometry[film.index(x, y)];
      require(is_finite(mean.color) && is_finite(mean.normal) && is_finite(mean.albedo),
              "a pixel is not finite");
      require(is_finite(at.point) && std::isfinite(at.depth), "a pixel's place is not finite");
    }
  }
}

}  // namespace

const Registry& builtins() {
  static const Registry registry = [] {
    Registry made;
    register_builtins(made);
    return made;
  }();
  return registry;
}

void check_hit(const Hit& hit) {
  require(std::isfinite(hit.t) && is_finite(hit.point), "a hit is not finite");
  require(hit.u >= 0.0 && hit.u <= 1.0 && hit.v >= 0.0 && hit.v <= 1.0, "a hit lies outside its patch");
  const double length = glm::length(hit.normal);
  require(length == 0.0 || std::fabs(length - 1.0) < 1e-12, "a normal is not of length 1");
}

void exercise(Scene& scene) {
  std::size_t patches = 0;
  for (const SceneObject& object : scene.objects) patches += object.traced.surface.patches.size();
  if (patches > most_patches) return;
  const Tracer tracer = tracer_of(scene);
  trace(tracer);
  scene.film.width = scene.film.height = 2;
  const World world = make_world(scene, tracer);
  render(scene, world);
}

}  // namespace rondure
