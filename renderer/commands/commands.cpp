#include "renderer/commands/commands.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <utility>

namespace rondure {

void run_when_chosen(CLI::App& command, CommandContext& context, std::function<void()> action) {
  // The program's own options, --plugin, may also stand after the sub-command's name.
  command.fallthrough();
  command.callback([&context, action = std::move(action)] { context.action = action; });
}

}  // namespace rondure
