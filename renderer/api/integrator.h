// What an integrator is: a function from a camera ray to radiance, over a world that it can only query.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/api/legend.h"
#include "renderer/api/params.h"
#include "renderer/api/surface.h"
#include "renderer/intersect/ray.h"
#include "renderer/sampling/sampler.h"
#include "renderer/shading/world.h"

namespace rondure {

class Integrator {
 public:
  virtual ~Integrator() = default;
  // Radiance (linear RGB) arriving along `ray`. `first` is the ray's closest hit, already found by the
  // renderer for the feature layers (it converts to false on a miss). Must depend on its arguments alone.
  virtual dvec3 radiance(const World& world, const Ray& ray, const Hit& first, Sampler& sampler) const = 0;
  // For pictures whose colours are numbers; a preview shows it below the picture.
  virtual std::optional<Legend> legend() const { return {}; }
};

struct IntegratorFactory {
  std::string name;  // the scene's "type", and the stem of the file that implements it
  std::string summary;
  std::vector<ParameterDoc> parameters;
  std::function<std::unique_ptr<Integrator>(Params&)> create;
};

}  // namespace rondure
