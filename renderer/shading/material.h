// Materials: how light scatters at a surface point, and what the surface emits.
//
// Directions are unit, in world space, and leave the surface: `out` toward the viewer, `in` toward the light.
// `normal` is the surface's unit outward normal, never flipped. Diffuse, mirror and conductor act alike on
// both sides; a dielectric's inside is the side that the normal leaves. Emission leaves the outward side
// only.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "renderer/api/params.h"
#include "renderer/api/type_doc.h"
#include "renderer/shading/curvature_colors.h"
#include "renderer/shading/isolines.h"

namespace rondure {

struct Diffuse {
  dvec3 albedo{0.5};
};

struct Mirror {
  dvec3 reflectance{1.0};
};

// Smooth interface between the outside (index 1) and the inside.
struct Dielectric {
  double ior = 1.5;
  dvec3 transmittance{1.0};  // factor on each crossing
};

// GGX microfacets with the exact Fresnel reflectance of a metal of index eta + i k.
struct RoughConductor {
  dvec3 eta{0.2, 0.92, 1.1};
  dvec3 k{3.9, 2.45, 2.14};
  double alpha = 0.04;  // GGX width: the scene's roughness, squared
};

using Scattering = std::variant<Diffuse, Mirror, Dielectric, RoughConductor>;

struct Material {
  Scattering scattering = Diffuse{};
  dvec3 emission{0.0};  // radiance
  std::optional<Isolines> isolines{};
  std::optional<CurvatureColors> curvature{};  // in place of a Diffuse albedo, except on isolines
};

struct ScatterSample {
  dvec3 direction{0.0};
  dvec3 weight{0.0};  // f |cos| / density
  double pdf = 0.0;   // per solid angle; of no meaning when `specular`
  bool specular = false;
  // Factor in `weight` that is no loss but the squeezing of solid angle by refraction. Roulette should divide
  // it out.
  double squeeze = 1.0;
};

// Whether all scattering is in directions of measure zero, which no light sample can hit.
bool is_specular(const Material& material);
bool emits(const Material& material);

// Empty when the light is absorbed.
std::optional<ScatterSample> sample_scattering(const Material& material, const dvec3& normal,
                                               const dvec3& out, double lobe, dvec2 uv);
// f |cos| toward `in`; zero for specular materials.
dvec3 evaluate_scattering(const Material& material, const dvec3& normal, const dvec3& out, const dvec3& in);
// Density per solid angle with which sample_scattering draws `in`; zero for specular materials.
double scattering_pdf(const Material& material, const dvec3& normal, const dvec3& out, const dvec3& in);
// Share of light that comes back, in [0, 1], for the feature layer.
dvec3 albedo(const Material& material, const dvec3& normal, const dvec3& out);

// Reads the object at hand, "type" included, and finishes it.
Material read_material(Params& params);
const std::vector<TypeDoc>& material_docs();

}  // namespace rondure
