// Light that reaches a hit straight from its source, gathered in two ways that share the work by multiple
// importance sampling (Veach and Guibas 1995, power heuristic): a light sample at the hit, and whatever the
// scattered ray finds.
#pragma once

#include <optional>

#include "renderer/sampling/sampler.h"
#include "renderer/shading/world.h"

namespace rondure {

// Share of a sample of density `own` when another technique draws the same direction with density `other`.
inline double power_heuristic(double own, double other) {
  const double ratio = other / own;
  return 1.0 / (1.0 + ratio * ratio);
}

// Where a path meets a surface of `material`: the light of one light sample that leaves toward `out`, and the
// way on, if any. `passed`: where the path has come along. Draws two single numbers and two pairs.
struct Bounce {
  dvec3 light{0.0};  // zero on specular materials
  std::optional<ScatterSample> scattered;
};
Bounce bounce(const World& world, const Material& material, const Hit& hit, const PassedWalls& passed,
              const dvec3& out, Sampler& sampler);

// From emission at `hit`, or from the background on a miss, along `ray`. `scattered` is how the ray came
// about; null for rays that no light sample competes with, such as a camera's.
dvec3 found_light(const World& world, const Ray& ray, const Hit& hit, const ScatterSample* scattered);

}  // namespace rondure
