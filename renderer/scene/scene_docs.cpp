#include "renderer/scene/scene_docs.h"

#include "renderer/camera/camera.h"
#include "renderer/film/film_settings.h"
#include "renderer/film/layer_reader.h"
#include "renderer/shading/light.h"
#include "renderer/shading/material.h"

namespace rondure {
namespace {

TypeDoc filter_doc(const std::string& name, const std::string& radius, const std::string& summary) {
  return {name,
          summary,
          {{"radius", "number in [0, 16]", radius, "half width in pixels; 0 stands for the default"}}};
}

std::vector<TypeDoc> filter_docs() {
  return {filter_doc("box", "0.5", "The plain mean over the pixel."),
          filter_doc("tent", "1", "Linear fall from the pixel's centre."),
          filter_doc("gaussian", "1.5", "A bell with a standard deviation of a third of the radius."),
          filter_doc("blackman_harris", "2",
                     "A four-term cosine window (Harris 1978): smooth, little aliasing.")};
}

}  // namespace

const std::vector<TypeDoc>& scene_docs() {
  static const std::vector<TypeDoc> docs = {
      {"scene",
       "The file: one JSON object, // and /* */ comments allowed.",
       {{"objects", "array of objects", "", "what there is to see; each names a surface by its \"type\""},
        {"camera", "object", "a three-quarter view that holds everything", "see perspective, orthographic"},
        {"film", "object", "{}", "see film"},
        {"sampling", "object", "{}", "see sampling"},
        {"integrator", "name or object", "\"path\"", "see rondure list"},
        {"materials", "object", "{}", "materials by name"},
        {"lights", "array of objects", "a constant light of 1, unless an object emits", "light from outside"},
        {"normals", "as of an object", "\"limit\"", "of all objects that name none"},
        {"name", "string", "\"\"", "a title"},
        {"comment", "string", "\"\"", "a remark"},
        {"$schema", "string", "\"\"", "where editors find scene.schema.json"}}},
      {"object",
       "What every object takes besides its own parameters: p becomes transform(center + radius p).",
       {{"type", "string", "", "the surface's family"},
        {"center", "point", "[0, 0, 0]", "where the unit surface's middle goes"},
        {"radius", "number > 0", "1", "factor on the unit surface"},
        {"transform", "4x4 matrix as rows, or array of steps", "[]",
         "steps, applied in order: {\"translate\": vector}, {\"rotate\": {\"axis\": vector, \"angle\": "
         "degrees}}, "
         "{\"scale\": number or vector}; a matrix may be projective, but for the analytic sphere"},
        {"material", "string", "a diffuse one of albedo 0.5", "a name under \"materials\""},
        {"show", "array of \"surface\", \"control_surface\", \"net\", \"boundary\", \"isolines\"",
         "[\"surface\"]",
         "the patches themselves; the flat pieces between control points; as wires the control net, with "
         "balls "
         "at its points, the boundary of each patch, the parameter lines inside it. iss also has "
         "\"spherical_triangle\" and "
         "\"domain\", the sides of its domains on the unit sphere and in their planes, and \"arcs\"; of a "
         "curve \"net\" is "
         "its "
         "control polygon"},
        {"wire", "number > 0", "0.01", "radius of the wires, in scene units whatever the object's radius"},
        {"wire_material", "string", "dark, or light on a dark surface",
         "a name under \"materials\"; wires alone have the object's \"material\" unless this is given"},
        {"isolines", "integer in [1, 100]", "8", "for \"show\": strips between lines, in each parameter"},
        {"solver", "\"auto\", \"newton\", \"clipping\", \"radial\" or \"quadric\"", "\"auto\"",
         "how rays find the surface: \"radial\" solves one polynomial for the whole ray, on inverse "
         "spherical patches with a planar projection domain; \"quadric\" meets patches that lie on a sphere "
         "or ellipsoid in closed form; other patches are then met as by \"newton\", and \"auto\" takes "
         "whichever the surface allows"},
        {"normals",
         "\"limit\", \"cross\", \"cross_float\", \"taylor\", \"shift\", \"hodograph\" or \"analytic\"",
         "the scene's",
         "the normals that shade it: the limit at singular points too, Su x Sv in double or in single "
         "precision, "
         "with a Taylor step or a shift of the parameters where that vanishes, the reduced normal "
         "polynomial, the "
         "quadric's gradient (black where there is no quadric)"},
        {"name", "string", "\"objects[i]\"", "what messages and lists call it"}}},
      {"sampling",
       "How many samples, and which.",
       {{"spp", "integer in [1, 1073741824]", "64", "samples per pixel"},
        {"seed", "integer in [0, 9007199254740991]", "1",
         "the same seed gives the same picture, bit by bit"}}},
  };
  return docs;
}

std::vector<TypeGroup> all_types(const Registry& registry) {
  TypeGroup families{"surface", {}}, integrators{"integrator", {}};
  for (const std::string& name : registry.family_names()) {
    const SurfaceFamily& family = *registry.family(name);
    families.types.push_back({name, family.summary, family.parameters});
  }
  for (const std::string& name : registry.integrator_names()) {
    const IntegratorFactory& integrator = *registry.integrator(name);
    integrators.types.push_back({name, integrator.summary, integrator.parameters});
  }
  TypeGroup layers{"layer", {}};
  for (const std::string& name : registry.layer_names()) {
    const LayerFactory& layer = *registry.layer(name);
    layers.types.push_back({name, layer.summary, layer.parameters});
    layers.types.back().parameters.push_back(layer_group_doc());
  }
  TypeGroup parts{"part of a scene", scene_docs()};
  for (const TypeDoc& doc : film_docs()) parts.types.push_back(doc);
  return {families,
          integrators,
          layers,
          {"material", material_docs()},
          {"light", light_docs()},
          {"camera", camera_docs()},
          {"filter", filter_docs()},
          parts};
}

}  // namespace rondure
