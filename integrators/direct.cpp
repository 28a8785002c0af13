// Light that is scattered once, seen directly or through any chain of mirrors and glass.

#include "integrators/integrators.h"
#include "renderer/shading/direct_light.h"

namespace rondure {
namespace {

class Direct : public Integrator {
 public:
  explicit Direct(int max_depth) : max_depth_(max_depth) {}

  dvec3 radiance(const World& world, const Ray& camera_ray, const Hit& first,
                 Sampler& sampler) const override {
    dvec3 result(0.0), throughput(1.0);
    Ray ray = camera_ray;
    Hit hit = first;
    PassedWalls passed;
    std::optional<ScatterSample> scattered;
    for (int depth = 0;; ++depth) {
      result += throughput * found_light(world, ray, hit, scattered ? &*scattered : nullptr);
      const bool done = scattered && !scattered->specular;
      if (!hit || done || depth == max_depth_) return result;
      sampler.start_block(depth + 1);
      const Bounce here = bounce(world, world.material(hit), hit, passed, -ray.direction, sampler);
      result += throughput * here.light;
      scattered = here.scattered;
      if (!scattered) return result;
      throughput *= scattered->weight;
      ray = spawn(hit, scattered->direction, passed);
      hit = world.tracer().closest(ray);
      passed.arrive(ray, hit);
    }
  }

 private:
  int max_depth_;
};

std::unique_ptr<Integrator> create_direct(Params& params) {
  return std::make_unique<Direct>(static_cast<int>(params.integer("max_depth", 32, 0, 100000)));
}

}  // namespace

void register_direct(Registry& registry) {
  registry.add(IntegratorFactory{"direct",
                                 "Direct light only: scattered once, after any number of mirrors and glass.",
                                 {{"max_depth", "integer in [0, 100000]", "32",
                                   "longest chain of mirrors and glass, and the last scattering"}},
                                 create_direct});
}

}  // namespace rondure
