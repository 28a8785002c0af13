// rondure list: the names that a scene may use.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "renderer/commands/commands.h"
#include "renderer/scene/scene_docs.h"

namespace rondure {

void run_list(const Registry& registry) {
  const std::vector<TypeGroup> groups = all_types(registry);
  std::size_t width = 0;
  for (const TypeGroup& group : groups) {
    for (const TypeDoc& type : group.types) width = std::max(width, type.name.size());
  }
  std::string text;
  const auto out = std::back_inserter(text);
  for (const TypeGroup& group : groups) {
    fmt::format_to(out, "{}{}:\n", &group == &groups.front() ? "" : "\n", group.kind);
    for (const TypeDoc& type : group.types)
      fmt::format_to(out, "  {:{}}  {}\n", type.name, width, type.summary);
  }
  std::fputs(text.c_str(), stdout);  // fmt::print throws, in words of its own, once a buffer is full
}

}  // namespace rondure
