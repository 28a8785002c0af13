// The program: one sub-command a run. The only place that catches.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>

#include "renderer/api/version.h"
#include "renderer/commands/commands.h"
#include "renderer/plugin/builtin.h"
#include "renderer/plugin/loader.h"
#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> option_names(const CLI::App& program, const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* app : {&command, &program}) {
    for (const CLI::Option* option : app->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// CLI11's words, but for a name that nobody knows.
std::string explain(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const std::vector<std::string> extras = program.remaining(true);
  if (chosen.empty()) {
    if (extras.empty()) return std::string(error.what()) + "; see rondure --help";
    if (!extras[0].starts_with("-")) return unknown_name("command", extras[0], command_names(program));
    return unknown_name("option", extras[0], option_names(program, program));
  }
  const std::string remedy = fmt::format("; see rondure {} --help", chosen[0]->get_name());
  if (extras.empty()) return error.what() + remedy;
  if (!extras[0].starts_with("-")) return fmt::format("unexpected argument \"{}\"{}", extras[0], remedy);
  return unknown_name("option", extras[0], option_names(program, *chosen[0]));
}

// A standard descriptor that came closed would go to the next file that is opened, and messages would land in
// that file. It becomes /dev/null, opened the wrong way round: reading and writing still fail, as they
// should.
void hold_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free descriptor is this one.
    if (open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY) != descriptor)
      throw std::runtime_error("a standard descriptor is closed, and /dev/null does not open");
  }
}

// A full disk shows only when the buffers are emptied.
void flush_output() {
  if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout))
    throw std::runtime_error("cannot write to standard output");
}

int run(int argc, char** argv) {
  hold_standard_descriptors();
  CLI::App program("Ray tracing of exact rational Bezier surfaces", "rondure");
  program.set_version_flag("--version", std::string("rondure ") + version);
  program.require_subcommand(1);
  CommandContext context;
  program
      .add_option("--plugin", context.plugins, "Load a plugin, or all plugins of a folder; may be repeated")
      ->type_name("PATH")
      ->allow_extra_args(false);
  add_render(program, context);
  add_trace(program, context);
  add_eval(program, context);
  add_info(program, context);
  add_export(program, context);
  add_validate(program, context);
  add_list(program, context);
  add_describe(program, context);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    const int code = program.exit(request);
    flush_output();
    return code;
  } catch (const CLI::ParseError& error) {
    throw std::runtime_error(explain(program, error));
  }
  register_builtins(context.registry);
  load_plugins(context.plugins, context.registry);
  context.action();
  flush_output();
  return 0;
}

int fail(const char* message) {
  // Nothing is left to do where even this cannot be written; fmt::print would throw.
  for (const char* text : {"rondure: error: ", message, "\n"}) std::fputs(text, stderr);
  return 1;
}

}  // namespace
}  // namespace rondure

int main(int argc, char** argv) {
  try {
    return rondure::run(argc, argv);
  } catch (const std::bad_alloc&) {
    return rondure::fail("out of memory");
  } catch (const std::exception& error) {
    return rondure::fail(error.what());
  }
}
