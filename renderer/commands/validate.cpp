// rondure validate: whether a scene can be rendered, short of rendering it.
#include <fmt/format.h>

#include <cstdio>

#include "renderer/commands/commands.h"
#include "renderer/commands/scene_warnings.h"
#include "renderer/commands/tracer_of.h"
#include "renderer/render/render.h"
#include "renderer/scene/scene_reader.h"

namespace rondure {
namespace {

const char* plural(std::size_t n) { return n == 1 ? "" : "s"; }

}  // namespace

void run_validate(const Registry& registry, const SceneOptions& options) {
  Scene scene = read_scene(options.path, registry, options.overrides);
  const std::vector<std::string> warnings = scene_warnings(scene);
  const Tracer tracer = tracer_of(scene);         // refuses nets that no solver can bound
  const World world = make_world(scene, tracer);  // reads images
  const TracerStatistics count = tracer.statistics();
  for (const std::string& warning : warnings) std::fputs((warning + "\n").c_str(), stderr);
  fmt::print("{}: valid, {} object{}, {} patch{}, {} light{}, {} material{}\n", options.path,
             scene.objects.size(), plural(scene.objects.size()), count.patches,
             count.patches == 1 ? "" : "es", scene.lights.size(), plural(scene.lights.size()),
             scene.materials.size(), plural(scene.materials.size()));
}

}  // namespace rondure
