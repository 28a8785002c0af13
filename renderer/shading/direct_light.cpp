#include "renderer/shading/direct_light.h"

#include <glm/geometric.hpp>

namespace rondure {
namespace {

// Whether light goes the same way through the surface by the normal that shades as by the one it has.
// Otherwise it would pass through, or be caught inside: it is absorbed, and no wrong normal adds energy.
bool consistent(const dvec3& shading, const dvec3& normal, const dvec3& out, const dvec3& in) {
  const auto crosses = [&](const dvec3& n) { return glm::dot(n, out) * glm::dot(n, in) < 0.0; };
  return shading == normal || crosses(shading) == crosses(normal);
}

dvec3 sampled_light(const World& world, const Material& material, const Hit& hit, const PassedWalls& passed,
                    const dvec3& normal, const dvec3& out, double choice, dvec2 uv) {
  if (is_specular(material)) return dvec3(0.0);
  const LightSample light = world.sample_light(hit.point, choice, uv);
  if (!(light.pdf > 0.0)) return dvec3(0.0);
  const dvec3 scattered = evaluate_scattering(material, normal, out, light.direction) * light.radiance;
  if (scattered == dvec3(0.0) || !consistent(normal, hit.normal, out, light.direction) ||
      !world.visible(hit, light, passed))
    return dvec3(0.0);
  const double share =
      light.delta ? 1.0 : power_heuristic(light.pdf, scattering_pdf(material, normal, out, light.direction));
  return scattered * (share / light.pdf);
}

}  // namespace

Bounce bounce(const World& world, const Material& material, const Hit& hit, const PassedWalls& passed,
              const dvec3& out, Sampler& sampler) {
  const double choice = sampler.next_1d(), lobe = sampler.next_1d();
  const dvec2 light_uv = sampler.next_2d(), scatter_uv = sampler.next_2d();
  const dvec3 normal = world.shading_normal(hit);
  if (normal == dvec3(0.0)) return {};
  Bounce result{sampled_light(world, material, hit, passed, normal, out, choice, light_uv),
                sample_scattering(material, normal, out, lobe, scatter_uv)};
  if (result.scattered && !consistent(normal, hit.normal, out, result.scattered->direction))
    result.scattered.reset();
  return result;
}

dvec3 found_light(const World& world, const Ray& ray, const Hit& hit, const ScatterSample* scattered) {
  const dvec3 radiance = hit ? world.emitted(hit, -ray.direction) : world.background(ray.direction);
  if (scattered == nullptr || scattered->specular || radiance == dvec3(0.0)) return radiance;
  const double light = hit ? world.light_pdf(ray.origin, hit) : world.background_pdf(ray.direction);
  return radiance * power_heuristic(scattered->pdf, light);
}

}  // namespace rondure
