#include "renderer/shading/material.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "renderer/sampling/warps.h"
#include "renderer/shading/fresnel.h"
#include "renderer/shading/ggx.h"

namespace rondure {
namespace {

constexpr double inv_pi = std::numbers::inv_pi;

template <class... F>
struct Overload : F... {
  using F::operator()...;
};
template <class... F>
Overload(F...) -> Overload<F...>;

// The side of the surface on which `out` lies.
dvec3 facing(const dvec3& normal, const dvec3& out) { return glm::dot(normal, out) < 0.0 ? -normal : normal; }

dvec3 reflect(const dvec3& out, const dvec3& normal) { return 2.0 * glm::dot(out, normal) * normal - out; }

// The same off a surface, which the light leaves on the side where it came, however it grazes: by less than
// rounding it would go on along the wall on either.
dvec3 bounce_off(const dvec3& normal, const dvec3& out) {
  constexpr double least = 0x1p-50;
  const double height = glm::dot(out, normal);
  return 2.0 * std::copysign(std::max(std::fabs(height), least), height) * normal - out;
}

using Sampled = std::optional<ScatterSample>;

Sampled sample(const Diffuse& m, const dvec3& normal, const dvec3& out, double, dvec2 uv) {
  const dvec3 local = sample_cosine_hemisphere(uv);
  if (local.z <= 0.0) return {};
  return ScatterSample{frame_about(facing(normal, out)).to_world(local), m.albedo, local.z * inv_pi};
}

Sampled sample(const Mirror& m, const dvec3& normal, const dvec3& out, double, dvec2) {
  return ScatterSample{glm::normalize(bounce_off(normal, out)), m.reflectance, 0.0, true};
}

Sampled sample(const Dielectric& m, const dvec3& normal, const dvec3& out, double lobe, dvec2) {
  const double side = glm::dot(normal, out);
  const dvec3 n = side < 0.0 ? -normal : normal;
  const double eta = side < 0.0 ? 1.0 / m.ior : m.ior;  // far over near
  const double cosine = std::min(1.0, std::abs(side));
  const double reflectance = fresnel_dielectric(cosine, eta);
  if (lobe < reflectance) return ScatterSample{glm::normalize(bounce_off(n, out)), dvec3(1.0), 0.0, true};
  const double far = std::sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
  const dvec3 direction = glm::normalize((cosine / eta - far) * n - out / eta);
  // Radiance over index squared is what an interface conserves.
  const double squeeze = 1.0 / (eta * eta);
  return ScatterSample{direction, m.transmittance * squeeze, 0.0, true, squeeze};
}

Sampled sample(const RoughConductor& m, const dvec3& normal, const dvec3& out, double, dvec2 uv) {
  const Frame frame = frame_about(facing(normal, out));
  const Ggx ggx{m.alpha};
  const dvec3 o = frame.to_local(out);
  if (o.z <= 0.0) return {};
  const dvec3 h = ggx.sample_visible(o, uv);
  const dvec3 i = reflect(o, h);
  const double cosine = glm::dot(o, h);
  if (i.z <= 0.0 || cosine <= 0.0) return {};
  const double masking = ggx.masking(o);
  const dvec3 weight = fresnel_conductor(cosine, m.eta, m.k) * (ggx.masking_shadowing(o, i) / masking);
  return ScatterSample{glm::normalize(frame.to_world(i)), weight, masking * ggx.density(h) / (4.0 * o.z)};
}

struct Evaluation {
  dvec3 value{0.0};  // f |cos|
  double pdf = 0.0;
};

Evaluation evaluate(const Diffuse& m, const dvec3& normal, const dvec3& out, const dvec3& in) {
  const double cosine = glm::dot(facing(normal, out), in);
  if (cosine <= 0.0) return {};
  return {m.albedo * (cosine * inv_pi), cosine * inv_pi};
}

Evaluation evaluate(const RoughConductor& m, const dvec3& normal, const dvec3& out, const dvec3& in) {
  const Frame frame = frame_about(facing(normal, out));
  const Ggx ggx{m.alpha};
  const dvec3 o = frame.to_local(out), i = frame.to_local(in);
  if (o.z <= 0.0 || i.z <= 0.0) return {};
  const dvec3 h = glm::normalize(o + i);
  const double density = ggx.density(h) / (4.0 * o.z);
  return {
      fresnel_conductor(std::min(1.0, glm::dot(o, h)), m.eta, m.k) * (density * ggx.masking_shadowing(o, i)),
      density * ggx.masking(o)};
}

Evaluation evaluate(const Mirror&, const dvec3&, const dvec3&, const dvec3&) { return {}; }
Evaluation evaluate(const Dielectric&, const dvec3&, const dvec3&, const dvec3&) { return {}; }

}  // namespace

bool is_specular(const Material& material) {
  return std::holds_alternative<Mirror>(material.scattering) ||
         std::holds_alternative<Dielectric>(material.scattering);
}

bool emits(const Material& material) { return material.emission != dvec3(0.0); }

std::optional<ScatterSample> sample_scattering(const Material& material, const dvec3& normal,
                                               const dvec3& out, double lobe, dvec2 uv) {
  return std::visit([&](const auto& m) { return sample(m, normal, out, lobe, uv); }, material.scattering);
}

dvec3 evaluate_scattering(const Material& material, const dvec3& normal, const dvec3& out, const dvec3& in) {
  return std::visit([&](const auto& m) { return evaluate(m, normal, out, in).value; }, material.scattering);
}

double scattering_pdf(const Material& material, const dvec3& normal, const dvec3& out, const dvec3& in) {
  return std::visit([&](const auto& m) { return evaluate(m, normal, out, in).pdf; }, material.scattering);
}

dvec3 albedo(const Material& material, const dvec3& normal, const dvec3& out) {
  return std::visit(
      Overload{[](const Diffuse& m) { return m.albedo; }, [](const Mirror& m) { return m.reflectance; },
               // White: what is not reflected goes on, and the feature layer does not follow it.
               [](const Dielectric&) { return dvec3(1.0); },
               [&](const RoughConductor& m) {
                 return fresnel_conductor(std::min(1.0, std::abs(glm::dot(normal, out))), m.eta, m.k);
               }},
      material.scattering);
}

}  // namespace rondure
