// An integrator: one value where a camera ray hits, black elsewhere.
#include "renderer/api/registry.h"

namespace rondure {
namespace {

class Silhouette final : public Integrator {
 public:
  explicit Silhouette(double value) : value_(value) {}
  dvec3 radiance(const World&, const Ray&, const Hit& first, Sampler&) const override {
    return dvec3(first ? value_ : 0.0);
  }

 private:
  double value_;
};

}  // namespace

void register_silhouette(Registry& registry) {
  IntegratorFactory factory;
  factory.name = "silhouette";
  factory.summary = "one value where there is a surface, from a plugin";
  factory.parameters = {{"value", "number >= 0", "1", "radiance of a hit"}};
  factory.create = [](Params& params) {
    return std::make_unique<Silhouette>(params.number("value", 1.0, Range::not_negative()));
  };
  registry.add(factory);
}

}  // namespace rondure
