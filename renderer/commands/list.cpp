// rondure list: the names that a scene may use.
#include <fmt/format.h>

#include <algorithm>

#include "renderer/commands/commands.h"
#include "renderer/scene/scene_docs.h"

namespace rondure {

void run_list(const Registry& registry) {
  const std::vector<TypeGroup> groups = all_types(registry);
  std::size_t width = 0;
  for (const TypeGroup& group : groups) {
    for (const TypeDoc& type : group.types) width = std::max(width, type.name.size());
  }
  for (const TypeGroup& group : groups) {
    fmt::print("{}{}:\n", &group == &groups.front() ? "" : "\n", group.kind);
    for (const TypeDoc& type : group.types) fmt::print("  {:{}}  {}\n", type.name, width, type.summary);
  }
}

}  // namespace rondure
