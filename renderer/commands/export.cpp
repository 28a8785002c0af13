// rondure export: the control nets of a scene, as a scene of raw nets.
//
// Whatever families, constructions and transforms an object went through, what is written are the homogeneous
// nets that rays meet, number by number: read back, they give the same bits. Other programs read them as
// JSON.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "renderer/bezier/net_text.h"
#include "renderer/bezier/triangle_to_tensor.h"
#include "renderer/commands/commands.h"
#include "renderer/commands/csv.h"
#include "renderer/commands/distinct_paths.h"
#include "renderer/commands/export_preimage.h"
#include "renderer/scene/scene_reader.h"
#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

// One patch, or the tensor-product patches that stand for a triangular one.
std::vector<std::string> texts_of(const Net& net, const std::string& form) {
  const auto* triangle = std::get_if<TriangleNet>(&net);
  if (!triangle) return {tensor_text(std::get<TensorNet>(net))};
  if (form == "degenerate") return {tensor_text(as_degenerate_tensor(*triangle))};
  if (form == "triangles") return {triangle_text(*triangle)};
  std::vector<std::string> parts;
  for (const TensorNet& part : as_three_tensors(*triangle)) parts.push_back(tensor_text(part));
  return parts;
}

std::string text_of(const dvec3& p) { return fmt::format("[{}, {}, {}]", p.x, p.y, p.z); }

// The closed form, as the unit sphere under a matrix.
void write_ellipsoid(TextOutput& output, const dmat3& map, const dvec3& origin) {
  output.write("\"type\": \"sphere\", \"transform\": [");
  for (int r = 0; r < 3; ++r)
    output.write(fmt::format("[{}, {}, {}, {}], ", map[0][r], map[1][r], map[2][r], origin[r]));
  output.write("[0, 0, 0, 1]] }");
}

void write_object(TextOutput& output, const SceneObject& object, const std::string& form) {
  const Surface& surface = object.traced.surface;
  if (surface.ellipsoid) return write_ellipsoid(output, *surface.ellipsoid, surface.origin);
  output.write(fmt::format("\"type\": \"bezier\", \"closed\": {}, \"center\": {}, \"patches\": [",
                           surface.closed, text_of(surface.origin)));
  const char* separator = "\n";
  for (const Net& net : surface.patches) {
    for (const std::string& patch : texts_of(net, form)) {
      output.write(separator + ("      " + patch));
      separator = ",\n";
    }
  }
  output.write(" ] }");
}

}  // namespace

void run_export(const Registry& registry, const ExportCommand& options) {
  const std::vector<std::string> forms = {"triangles", "degenerate", "quadrilaterals", "preimage"};
  if (std::find(forms.begin(), forms.end(), options.form) == forms.end())
    throw std::runtime_error("--form: " + unknown_name("form", options.form, forms));
  const Scene scene = read_scene(options.scene.path, registry, options.scene.overrides);
  refuse_table_over_input(scene, "-", options.output);
  // Those that have none are told before anything is written.
  std::vector<std::string> preimages;
  if (options.form == "preimage")
    for (const SceneObject& object : scene.objects) preimages.push_back(preimage_members(scene, object));
  TextOutput output(options.output);
  output.write("{\n  \"objects\": [");
  const char* separator = "\n";
  for (std::size_t k = 0; k < scene.objects.size(); ++k) {
    const SceneObject& object = scene.objects[k];
    output.write(fmt::format("{}    {{ \"name\": {}, ", separator, nlohmann::json(object.name).dump()));
    if (preimages.empty())
      write_object(output, object, options.form);
    else
      output.write(preimages[k]);
    separator = ",\n";
  }
  output.write("\n  ]\n}\n");
  output.finish();
}

}  // namespace rondure
