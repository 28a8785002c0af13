// The sub-commands of the program, one file each.
//
// Every add_NAME describes its sub-command to CLI11 and hands its action to run_when_chosen. Actions run
// after the whole command line is parsed and the plugins are loaded. They throw to fail: only main catches,
// prints "rondure: error: ..." and returns 1. Results go to the named file or to standard output, all else to
// standard error. For example:
//
//   void add_info(CLI::App& program, CommandContext& context) {
//     CLI::App* command = program.add_subcommand("info", "Print what a scene holds");
//     auto options = std::make_shared<InfoOptions>();
//     add_scene_options(*command, options->scene);  // renderer/commands/scene_options.h
//     command->add_flag("--json", options->json, "Print JSON");
//     run_when_chosen(*command, context, [&context, options] { info(context.registry, *options); });
//   }
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/api/registry.h"

namespace CLI {
class App;
}

namespace rondure {

struct CommandContext {
  Registry registry;                 // built-ins and plugins, complete when the action runs
  std::vector<std::string> plugins;  // paths given by --plugin
  std::function<void()> action;      // of the chosen sub-command
};

void run_when_chosen(CLI::App& command, CommandContext& context, std::function<void()> action);

void add_render(CLI::App& program, CommandContext& context);
void add_trace(CLI::App& program, CommandContext& context);
void add_eval(CLI::App& program, CommandContext& context);
void add_info(CLI::App& program, CommandContext& context);
void add_export(CLI::App& program, CommandContext& context);
void add_validate(CLI::App& program, CommandContext& context);
void add_list(CLI::App& program, CommandContext& context);
void add_describe(CLI::App& program, CommandContext& context);

}  // namespace rondure
