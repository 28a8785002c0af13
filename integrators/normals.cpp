// The surface normal as a colour, to look at geometry without light.

#include "integrators/integrators.h"

namespace rondure {
namespace {

class Normals : public Integrator {
 public:
  dvec3 radiance(const World& world, const Ray&, const Hit& first, Sampler&) const override {
    return first ? 0.5 * (world.shading_normal(first) + dvec3(1.0)) : dvec3(0.0);
  }
};

}  // namespace

void register_normals(Registry& registry) {
  registry.add(
      IntegratorFactory{"normals",
                        "The outward normal n as the colour (n + 1) / 2; black where nothing is hit.",
                        {},
                        [](Params&) { return std::make_unique<Normals>(); }});
}

}  // namespace rondure
