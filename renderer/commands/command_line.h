// The command line of the program.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/api/registry.h"

namespace rondure {

struct CommandLine {
  std::vector<std::string> plugins;             // paths given by --plugin
  std::function<void(const Registry&)> action;  // of the chosen sub-command; none after --help or --version
};

// Prints what --help and --version ask for. Throws std::runtime_error for what it does not understand.
CommandLine read_command_line(int argc, char** argv);

}  // namespace rondure
