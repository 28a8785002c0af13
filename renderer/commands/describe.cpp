// rondure describe: one type and its parameters.
#include <fmt/format.h>

#include <cstdio>
#include <iterator>
#include <stdexcept>

#include "renderer/commands/commands.h"
#include "renderer/scene/scene_docs.h"
#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

void append_type(std::string& text, const std::string& kind, const TypeDoc& type) {
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{} ({})\n{}\n", type.name, kind, type.summary);
  for (const ParameterDoc& parameter : type.parameters) {
    fmt::format_to(out, "\n  {}: {}\n", parameter.name, parameter.type);
    fmt::format_to(out, "      {}\n", parameter.meaning);
    if (parameter.default_value.empty()) {
      fmt::format_to(out, "      required\n");
    } else {
      fmt::format_to(out, "      default: {}\n", parameter.default_value);
    }
  }
  if (kind == "surface") {
    fmt::format_to(out, "\n  and what every object takes: see rondure describe object\n");
  } else if (type.parameters.empty()) {
    fmt::format_to(out, "\n  no parameters\n");
  }
}

}  // namespace

void run_describe(const Registry& registry, const std::string& name) {
  std::vector<std::string> names;
  std::string text;
  bool found = false;
  for (const TypeGroup& group : all_types(registry)) {
    for (const TypeDoc& type : group.types) {
      names.push_back(type.name);
      if (type.name != name) continue;
      if (found) text += "\n";
      append_type(text, group.kind, type);
      found = true;
    }
  }
  if (!found) throw std::runtime_error(unknown_name("type", name, names));
  std::fputs(text.c_str(), stdout);  // fmt::print throws, in words of its own, once a buffer is full
}

}  // namespace rondure
