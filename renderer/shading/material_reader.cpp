#include <fmt/format.h>

#include "renderer/shading/material.h"

namespace rondure {
namespace {

const ParameterDoc emission_doc{"emission", "colour >= 0", "0", "radiance that leaves the outward side"};

// Below it (alpha = 1e-4) the lobe is as good as a mirror, and its density loses digits.
constexpr double least_roughness = 0.01;

const ParameterDoc isolines_doc{"isolines", "{ count, width, boundary_width, albedo }", "none",
                                "parameter lines on patches: strips between lines (8), widths in scene units "
                                "(0.01 and 0.02), ink (0.02)"};

const ParameterDoc curvature_doc{
    "curvature", "{ of, range }", "none",
    "colours patches by curvature in place of albedo: of \"gaussian\" (default) or "
    "\"mean\"; blue at the low end of range ([-1, 1]) and below, grey in its middle, "
    "red at its high end and above; an outward sphere of radius r has Gaussian 1 / "
    "r^2, mean -1 / r"};

Isolines read_isolines(Params params) {
  Isolines lines;
  lines.count = static_cast<int>(params.integer("count", lines.count, 1, 1000));
  lines.width = params.number("width", lines.width, Range::not_negative());
  lines.boundary_width = params.number("boundary_width", lines.boundary_width, Range::not_negative());
  lines.albedo = params.color("albedo", lines.albedo, Range::closed(0.0, 1.0));
  params.finish();
  return lines;
}

CurvatureColors read_curvature(Params params) {
  CurvatureColors colors;
  const bool mean = params.choice("of", {"gaussian", "mean"}, "gaussian") == "mean";
  colors.of = mean ? CurvatureColors::Kind::mean : CurvatureColors::Kind::gaussian;
  const dvec2 range = params.vec2("range", {colors.low, colors.high});
  if (!(range.x < range.y)) {
    params.fail("range", fmt::format("\"range\" must be [low, high] with low < high, found [{}, {}]", range.x,
                                     range.y));
  }
  colors.low = range.x;
  colors.high = range.y;
  params.finish();
  return colors;
}

}  // namespace

Material read_material(Params& params) {
  Material material;
  const std::string type =
      params.choice("type", {"diffuse", "mirror", "dielectric", "rough_conductor"}, "diffuse");
  const Range unit = Range::closed(0.0, 1.0);
  if (type == "diffuse") {
    material.scattering = Diffuse{params.color("albedo", Diffuse{}.albedo, unit)};
    if (params.has("curvature")) material.curvature = read_curvature(params.object("curvature"));
  } else if (type == "mirror") {
    material.scattering = Mirror{params.color("reflectance", Mirror{}.reflectance, unit)};
  } else if (type == "dielectric") {
    Dielectric m;
    m.ior = params.number("ior", m.ior, Range::closed(0.1, 10.0));
    m.transmittance = params.color("transmittance", m.transmittance, unit);
    material.scattering = m;
  } else {
    RoughConductor m;
    m.eta = params.color("eta", m.eta, Range::positive());
    m.k = params.color("k", m.k);
    const double roughness = params.number("roughness", 0.2, Range::closed(least_roughness, 1.0));
    m.alpha = roughness * roughness;
    material.scattering = m;
  }
  material.emission = params.color("emission", dvec3(0.0));
  if (params.has("isolines")) material.isolines = read_isolines(params.object("isolines"));
  params.finish();
  return material;
}

const std::vector<TypeDoc>& material_docs() {
  static const std::vector<TypeDoc> docs = {
      {"diffuse",
       "Scatters equally in all directions (Lambert 1760), on both sides.",
       {{"albedo", "colour in [0, 1]", "0.5", "share of light that is scattered"},
        emission_doc,
        isolines_doc,
        curvature_doc}},
      {"mirror",
       "Reflects in the one direction of the law of reflection, on both sides.",
       {{"reflectance", "colour in [0, 1]", "1", "share of light that is reflected"},
        emission_doc,
        isolines_doc}},
      {"dielectric",
       "Smooth clear interface, such as glass; the inside is where the normal leaves.",
       {{"ior", "number in [0.1, 10]", "1.5", "index of refraction inside, relative to outside"},
        {"transmittance", "colour in [0, 1]", "1", "factor on light that crosses"},
        emission_doc,
        isolines_doc}},
      {"rough_conductor",
       "Metal with GGX microfacets (Walter et al. 2007) and exact Fresnel reflectance, on both sides.",
       {{"eta", "colour > 0", "[0.2, 0.92, 1.1]", "index of refraction, real part; the default is copper's"},
        {"k", "colour >= 0", "[3.9, 2.45, 2.14]", "index of refraction, imaginary part"},
        {"roughness", "number in [0.01, 1]", "0.2", "square root of the GGX width alpha"},
        emission_doc,
        isolines_doc}},
  };
  return docs;
}

}  // namespace rondure
