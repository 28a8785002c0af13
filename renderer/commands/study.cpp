// rondure study: measurements and pictures of what parametrisation and precision do, as tables and a page.
#include <fmt/format.h>

#include <stdexcept>

#include "renderer/commands/commands.h"
#include "renderer/scene/unknown_name.h"
#include "renderer/study/corner_normals.h"
#include "renderer/study/parametrisation.h"
#include "renderer/study/precision.h"

namespace rondure {

namespace {

// As a POSIX shell reads one word.
std::string shell_word(const std::string& text) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

void run_study(const Registry& registry, const StudyCommand& command) {
  if (!command.scene.empty() && command.study != "corner-normals")
    throw std::runtime_error("--scene is for the study corner-normals; the others compare whole spheres");
  if (!command.scene.empty() && !command.families.empty())
    throw std::runtime_error("--scene takes the place of --families: give one of them");
  StudyOptions options;
  options.scene = command.scene;
  options.families = command.families;
  options.output = command.output.empty() ? command.study : command.output;
  options.quick = command.quick;
  options.quiet = command.quiet;
  options.command = "rondure study " + command.study;
  if (!command.families.empty())
    options.command += fmt::format(" --families {}", fmt::join(command.families, ","));
  if (!command.scene.empty()) options.command += " --scene " + shell_word(command.scene);
  for (const std::string& plugin : command.plugins) options.command += " --plugin " + shell_word(plugin);
  if (command.quick) options.command += " --quick";
  if (command.study == "corner-normals") return study_corner_normals(options, registry);
  if (command.study == "parametrisation") return study_parametrisation(options, registry);
  if (command.study == "precision") return study_precision(options, registry);
  throw std::runtime_error(
      unknown_name("study", command.study, {"corner-normals", "parametrisation", "precision"}));
}

}  // namespace rondure
