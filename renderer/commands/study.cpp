// rondure study: measurements and pictures of what parametrisation and precision do, as tables and a page.
#include <fmt/format.h>

#include <stdexcept>

#include "renderer/commands/commands.h"
#include "renderer/scene/unknown_name.h"
#include "renderer/study/corner_normals.h"
#include "renderer/study/parametrisation.h"
#include "renderer/study/precision.h"

namespace rondure {

void run_study(const Registry& registry, const StudyCommand& command) {
  StudyOptions options;
  options.families = command.families;
  options.output = command.output.empty() ? command.study : command.output;
  options.quick = command.quick;
  options.quiet = command.quiet;
  options.command = "rondure study " + command.study;
  if (!command.families.empty())
    options.command += fmt::format(" --families {}", fmt::join(command.families, ","));
  if (command.quick) options.command += " --quick";
  if (command.study == "corner-normals") return study_corner_normals(options, registry);
  if (command.study == "parametrisation") return study_parametrisation(options, registry);
  if (command.study == "precision") return study_precision(options, registry);
  throw std::runtime_error(
      unknown_name("study", command.study, {"corner-normals", "parametrisation", "precision"}));
}

}  // namespace rondure
