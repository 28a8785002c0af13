// Path tracing (Kajiya 1986) with a light sample at each vertex, multiple importance sampling and Russian
// roulette.

#include <algorithm>

#include "integrators/integrators.h"
#include "renderer/shading/direct_light.h"

namespace rondure {
namespace {

struct PathSettings {
  int max_depth = 32;
  int min_depth = 4;
};

class Path : public Integrator {
 public:
  explicit Path(PathSettings settings) : settings_(settings) {}

  dvec3 radiance(const World& world, const Ray& camera_ray, const Hit& first,
                 Sampler& sampler) const override {
    dvec3 result(0.0), throughput(1.0);
    double squeeze = 1.0;  // part of the throughput that is refraction's alone
    Ray ray = camera_ray;
    Hit hit = first;
    PassedWalls passed;
    std::optional<ScatterSample> scattered;
    for (int depth = 0;; ++depth) {
      result += throughput * found_light(world, ray, hit, scattered ? &*scattered : nullptr);
      if (!hit || depth == settings_.max_depth) return result;
      sampler.start_block(depth + 1);
      const Bounce here = bounce(world, world.material(hit), hit, passed, -ray.direction, sampler);
      const double roulette = sampler.next_1d();
      result += throughput * here.light;
      scattered = here.scattered;
      if (!scattered) return result;
      throughput *= scattered->weight;
      squeeze *= scattered->squeeze;
      const double survival = std::max({throughput.x, throughput.y, throughput.z}) / squeeze;
      if (!(survival > 0.0)) return result;
      if (depth >= settings_.min_depth && survival < 1.0) {
        if (roulette >= survival) return result;
        throughput /= survival;
      }
      ray = spawn(hit, scattered->direction, passed);
      hit = world.tracer().closest(ray);
      passed.arrive(ray, hit);
    }
  }

 private:
  PathSettings settings_;
};

std::unique_ptr<Integrator> create_path(Params& params) {
  PathSettings settings;
  settings.max_depth = static_cast<int>(params.integer("max_depth", settings.max_depth, 0, 100000));
  settings.min_depth = static_cast<int>(params.integer("min_depth", settings.min_depth, 0, 100000));
  return std::make_unique<Path>(settings);
}

}  // namespace

void register_path(Registry& registry) {
  registry.add(IntegratorFactory{
      "path",
      "Path tracing: all light, by light samples and scattering samples together.",
      {{"max_depth", "integer in [0, 100000]", "32", "scatterings on a path; 0 shows emission alone"},
       {"min_depth", "integer in [0, 100000]", "4", "scatterings before Russian roulette may end a path"}},
      create_path});
}

}  // namespace rondure
