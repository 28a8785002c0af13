#include "renderer/commands/scene_options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <charconv>

namespace rondure {
namespace {

// Two positive integers around an x.
bool parse_resolution(const std::string& text, std::pair<std::int64_t, std::int64_t>& size) {
  const char* end = text.data() + text.size();
  const auto [middle, error] = std::from_chars(text.data(), end, size.first);
  if (error != std::errc{} || middle == end || (*middle != 'x' && *middle != 'X')) return false;
  const auto [stop, error2] = std::from_chars(middle + 1, end, size.second);
  return error2 == std::errc{} && stop == end && size.first > 0 && size.second > 0;
}

}  // namespace

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command.add_option("scene", options.path, "Scene file (JSON)")->type_name("SCENE")->required();
  command
      .add_option("--set", options.overrides.set,
                  "Change a value of the scene before it is read; may be repeated")
      ->type_name("/json/pointer=value")
      ->allow_extra_args(false);
  command.add_option("--solver", options.overrides.solver, "Solver of every object: newton, clipping or radial")
      ->type_name("NAME");
}

void add_sampling_options(CLI::App& command, SceneOptions& options) {
  SceneOverrides& overrides = options.overrides;
  command.add_option("--spp", overrides.spp, "Samples per pixel")->type_name("N");
  command.add_option("--seed", overrides.seed, "Seed of the random numbers")->type_name("N");
  command
      .add_option_function<std::string>(
          "--resolution",
          [&overrides](const std::string& text) {
            std::pair<std::int64_t, std::int64_t> size;
            if (!parse_resolution(text, size)) {
              throw CLI::ValidationError("--resolution",
                                         "takes WIDTHxHEIGHT, such as 640x480, found \"" + text + "\"");
            }
            overrides.resolution = size;
          },
          "Size of the picture in pixels")
      ->type_name("WxH");
  command
      .add_option("--integrator", overrides.integrator,
                  "Integrator, with the scene's parameters if it names the same")
      ->type_name("NAME");
}

}  // namespace rondure
