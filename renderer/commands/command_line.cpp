#include "renderer/commands/command_line.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "renderer/api/version.h"
#include "renderer/commands/commands.h"
#include "renderer/commands/option_values.h"
#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

// Adds to the program a sub-command whose action is `run` with its options, which CLI11 fills until then.
template <class Options, class Action>
std::pair<CLI::App*, Options*> add(CLI::App& program, CommandLine& line, const char* name,
                                   const char* summary, Action run) {
  CLI::App* command = program.add_subcommand(name, summary);
  // The program's own options, --plugin, may also stand after the sub-command's name.
  command->fallthrough();
  auto options = std::make_shared<Options>();
  command->callback([&line, options, run] {
    if constexpr (requires { options->plugins; }) options->plugins = line.plugins;
    line.action = [options, run](const Registry& r) { run(r, *options); };
  });
  return {command, options.get()};
}

void add_output(CLI::App& command, std::string& path, const char* what) {
  command.add_option("-o,--output", path, fmt::format("{}; - for standard output (the default)", what))
      ->check(not_empty("names no file; - is standard output"));
}

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command.add_option("scene", options.path, "Scene file (JSON)")->type_name("SCENE")->required();
  command
      .add_option("--set", options.overrides.set,
                  "Change a value of the scene before it is read; may be repeated")
      ->type_name("/json/pointer=value")
      ->allow_extra_args(false);
  command
      .add_option("--solver", options.overrides.solver,
                  "Solver of every object: auto, newton, clipping, radial or quadric")
      ->type_name("NAME");
}

// --spp, --seed, --resolution WxH, --integrator, --normals, --layers.
void add_sampling_options(CLI::App& command, SceneOverrides& overrides) {
  const CLI::Validator given = not_empty("has no value");
  command.add_option("--spp", overrides.spp, "Samples per pixel")
      ->type_name("N")
      ->check(given)
      ->check(is_integer());
  command.add_option("--seed", overrides.seed, "Seed of the random numbers")
      ->type_name("N")
      ->check(given)
      ->check(is_integer());
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
  command
      .add_option("--normals", overrides.normals,
                  "What shades every object: limit, cross, cross_float, taylor, "
                  "shift, hodograph or analytic")
      ->type_name("NAME");
  command
      .add_option_function<std::vector<std::string>>(
          "--layers",
          [&overrides](const std::vector<std::string>& lists) { overrides.layers = split_names(lists); },
          "More layers of the film, with the scene's parameters where it has them; see rondure list")
      ->type_name("NAME,...")
      ->check(are_names())
      ->allow_extra_args(false);
}

void add_render(CLI::App& program, CommandLine& line) {
  const auto [command, options] =
      add<RenderCommand>(program, line, "render", "Render a scene to an OpenEXR file", run_render);
  add_scene_options(*command, options->scene);
  add_sampling_options(*command, options->scene.overrides);
  const CLI::Validator named = not_empty("names no file"), given = not_empty("has no value");
  command
      ->add_option("-o,--output", options->output,
                   "OpenEXR file (the scene's name in this folder by default)")
      ->check(named);
  CLI::Option* png =
      command->add_option("--png", options->png, "Also write an 8-bit sRGB preview")->check(named);
  command->add_option("--exposure", options->exposure, "Brighten the preview by this many stops")
      ->check(given)
      ->needs(png);
  command
      ->add_option("--threads", options->threads,
                   "Threads (all processors by default, or by 0); no effect on the picture")
      ->check(CLI::Range(0, 4096));
  command
      ->add_option("--crop", options->crop, "x0,y0,x1,y1: render the pixels x0 <= x < x1, y0 <= y < y1 alone")
      ->check(given);
  command->add_flag("--resume", options->resume,
                    "Keep the samples in OUTPUT.state, and go on from there if it exists");
  command->add_flag("--quiet", options->quiet, "No progress and no notes");
}

void add_trace(CLI::App& program, CommandLine& line) {
  const auto [command, options] =
      add<TraceCommand>(program, line, "trace", "Intersect rays from a table with a scene", run_trace);
  add_scene_options(*command, options->scene);
  command->add_option("--rays", options->rays, "Table ox,oy,oz,dx,dy,dz[,tmin,tmax]; - for standard input")
      ->check(not_empty("names no file; - is standard input"))
      ->required();
  add_output(*command, options->output, "Table of hits");
  CLI::Option* all =
      command->add_flag("--all", options->all, "Every hit of each ray, in order of t, not the closest alone");
  command
      ->add_flag("--certify", options->certify,
                 "Also write what is proven of the closest hit, and bounds on its errors")
      ->excludes(all);
}

void add_eval(CLI::App& program, CommandLine& line) {
  const auto [command, options] =
      add<EvalCommand>(program, line, "eval", "Evaluate a scene's patches at given parameters", run_eval);
  add_scene_options(*command, options->scene);
  const CLI::Validator named = not_empty("names no file; - is standard input");
  CLI::Option* at =
      command->add_option("--at", options->at, "Table surface,patch,u,v; - for standard input")->check(named);
  command
      ->add_option("--direction", options->directions,
                   "Table surface,dx,dy,dz of directions from the surface's centre; - for standard input")
      ->check(named)
      ->excludes(at);
  add_output(*command, options->output, "Table of values");
}

void add_info(CLI::App& program, CommandLine& line) {
  const auto [command, options] = add<InfoCommand>(
      program, line, "info",
      "Tell what a scene holds: patches, degrees, weights, bounds, area, volume, inertia, continuity, "
      "regularity, memory",
      run_info);
  add_scene_options(*command, options->scene);
  command->add_flag("--no-mass", options->no_mass, "Leave out area, volume, centroid and inertia");
  CLI::Option* without = command->add_flag("--no-continuity", options->no_continuity,
                                           "Leave out how patches meet and regularity");
  command
      ->add_flag("--certify", options->certify,
                 "Also prove in exact arithmetic that patches are regular, or that they are not")
      ->excludes(without);
  command->add_flag("--json", options->json, "Print JSON");
}

void add_export(CLI::App& program, CommandLine& line) {
  const auto [command, options] = add<ExportCommand>(
      program, line, "export", "Write the control nets of a scene as a scene of raw nets", run_export);
  add_scene_options(*command, options->scene);
  add_output(*command, options->output, "Scene file");
  command
      ->add_option(
          "--form", options->form,
          "Triangular patches as triangles (the default), as one degenerate tensor-product patch each, "
          "or as three quadrilaterals: degenerate, quadrilaterals; or preimage: patches of spheres as nets "
          "in "
          "projective space")
      ->type_name("NAME");
}

void add_study(CLI::App& program, CommandLine& line) {
  const auto [command, options] = add<StudyCommand>(
      program, line, "study", "Measure what parametrisation and precision do to normals, hits and pictures",
      run_study);
  command->add_option("study", options->study, "corner-normals, parametrisation or precision")
      ->type_name("STUDY")
      ->required();
  command
      ->add_option_function<std::vector<std::string>>(
          "--families",
          [options = options](const std::vector<std::string>& lists) {
            options->families = split_names(lists);
          },
          "Families, separated by commas; all of the study's by default. A name that is none is "
          "answered by all that are")
      ->type_name("NAME,...")
      ->check(are_names())
      ->allow_extra_args(false);
  command
      ->add_option("--scene", options->scene,
                   "For corner-normals: the objects of a scene instead of families")
      ->check(not_empty("names no file"));
  command->add_option("-o,--output", options->output, "Folder (the study's name in this folder by default)")
      ->check(not_empty("names no folder"));
  command->add_flag("--quick", options->quick, "Fewer places and smaller pictures, within a minute");
  command->add_flag("--quiet", options->quiet, "No progress");
}

void add_validate(CLI::App& program, CommandLine& line) {
  const auto [command, options] = add<SceneOptions>(
      program, line, "validate", "Check a scene and say what is wrong with it", run_validate);
  add_scene_options(*command, *options);
}

void add_list(CLI::App& program, CommandLine& line) {
  struct None {};
  add<None>(program, line, "list", "List surfaces, integrators, materials, lights and the rest",
            [](const Registry& registry, const None&) { run_list(registry); });
}

void add_describe(CLI::App& program, CommandLine& line) {
  const auto [command, name] = add<std::string>(
      program, line, "describe", "Print what a type is and the parameters that it takes", run_describe);
  command->add_option("type", *name, "A name that rondure list prints")->type_name("TYPE")->required();
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> option_names(const std::vector<const CLI::App*>& apps) {
  std::vector<std::string> names;
  for (const CLI::App* app : apps) {
    for (const CLI::Option* option : app->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// Of an option that was not expected where it stands: those in `here` may stand there, those in `elsewhere`
// at another place.
std::string unexpected_option(const std::string& text, const std::vector<std::string>& here,
                              const std::vector<std::string>& elsewhere, const std::string& remedy) {
  const std::string name = text.substr(0, text.find('='));
  if (std::find(elsewhere.begin(), elsewhere.end(), name) == elsewhere.end())
    return unknown_name("option", text, here);
  return fmt::format(
      "\"{}\" is an option of a command: it stands after the command's name, and before any --{}", name,
      remedy);
}

// CLI11's words, but for a name that nobody knows.
std::string explain(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const std::vector<std::string> extras = program.remaining(true);
  if (chosen.empty()) {
    const char* const remedy = "; see rondure --help";
    if (extras.empty()) return error.what() + std::string(remedy);
    if (!extras[0].starts_with("-")) return unknown_name("command", extras[0], command_names(program));
    std::vector<const CLI::App*> all = program.get_subcommands([](const CLI::App*) { return true; });
    return unexpected_option(extras[0], option_names({&program}), option_names(all), remedy);
  }
  const std::string remedy = fmt::format("; see rondure {} --help", chosen[0]->get_name());
  if (extras.empty()) return error.what() + remedy;
  if (!extras[0].starts_with("-")) return fmt::format("unexpected argument \"{}\"{}", extras[0], remedy);
  const std::vector<std::string> names = option_names({chosen[0], &program});
  return unexpected_option(extras[0], names, names, remedy);
}

// CLI11 takes the next argument for the value that is missing behind "=".
void refuse_empty_values(int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    const std::string_view text = argv[k];
    if (text == "--") return;
    const bool is_short = text.size() == 3 && text[0] == '-';
    if ((text.starts_with("--") || is_short) && text.find('=') == text.size() - 1)
      throw std::runtime_error(
          fmt::format("{}: has no value; see rondure --help", text.substr(0, text.size() - 1)));
  }
}

}  // namespace

CommandLine read_command_line(int argc, char** argv) {
  CLI::App program("Ray tracing of exact rational Bezier surfaces", "rondure");
  program.set_version_flag("--version", std::string("rondure ") + version);
  program.require_subcommand(1);
  CommandLine line;
  program.add_option("--plugin", line.plugins, "Load a plugin, or all plugins of a folder; may be repeated")
      ->type_name("PATH")
      ->allow_extra_args(false);
  add_render(program, line);
  add_trace(program, line);
  add_eval(program, line);
  add_info(program, line);
  add_export(program, line);
  add_study(program, line);
  add_validate(program, line);
  add_list(program, line);
  add_describe(program, line);
  refuse_empty_values(argc, argv);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    program.exit(request);
  } catch (const CLI::ParseError& error) {
    throw std::runtime_error(explain(program, error));
  }
  return line;
}

}  // namespace rondure
