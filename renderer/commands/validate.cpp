// rondure validate: whether a scene can be rendered, short of rendering it.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>

#include "renderer/commands/commands.h"
#include "renderer/commands/scene_options.h"
#include "renderer/commands/tracer_of.h"
#include "renderer/render/render.h"
#include "renderer/scene/scene_reader.h"

namespace rondure {
namespace {

const char* plural(std::size_t n) { return n == 1 ? "" : "s"; }

void validate(const Registry& registry, const SceneOptions& options) {
  Scene scene = read_scene(options.path, registry, options.overrides);
  const Tracer tracer = tracer_of(scene);         // refuses nets that no solver can bound
  const World world = make_world(scene, tracer);  // reads images
  const TracerStatistics count = tracer.statistics();
  fmt::print("{}: valid, {} object{}, {} patch{}, {} light{}, {} material{}\n", options.path,
             scene.objects.size(), plural(scene.objects.size()), count.patches,
             count.patches == 1 ? "" : "es", scene.lights.size(), plural(scene.lights.size()),
             scene.materials.size(), plural(scene.materials.size()));
}

}  // namespace

void add_validate(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("validate", "Check a scene and say what is wrong with it");
  auto options = std::make_shared<SceneOptions>();
  add_scene_options(*command, *options);
  run_when_chosen(*command, context, [&context, options] { validate(context.registry, *options); });
}

}  // namespace rondure
