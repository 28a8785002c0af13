// rondure describe: one type and its parameters.
#include <fmt/format.h>

#include <stdexcept>

#include "renderer/commands/commands.h"
#include "renderer/scene/scene_docs.h"
#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

void print_type(const std::string& kind, const TypeDoc& type) {
  fmt::print("{} ({})\n{}\n", type.name, kind, type.summary);
  for (const ParameterDoc& parameter : type.parameters) {
    fmt::print("\n  {}: {}\n", parameter.name, parameter.type);
    fmt::print("      {}\n", parameter.meaning);
    if (parameter.default_value.empty()) {
      fmt::print("      required\n");
    } else {
      fmt::print("      default: {}\n", parameter.default_value);
    }
  }
  if (kind == "surface") {
    fmt::print("\n  and what every object takes: see rondure describe object\n");
  } else if (type.parameters.empty()) {
    fmt::print("\n  no parameters\n");
  }
}

}  // namespace

void run_describe(const Registry& registry, const std::string& name) {
  std::vector<std::string> names;
  bool found = false;
  for (const TypeGroup& group : all_types(registry)) {
    for (const TypeDoc& type : group.types) {
      names.push_back(type.name);
      if (type.name != name) continue;
      if (found) fmt::print("\n");
      print_type(group.kind, type);
      found = true;
    }
  }
  if (!found) throw std::runtime_error(unknown_name("type", name, names));
}

}  // namespace rondure
