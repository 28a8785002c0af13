// What `rondure describe` prints of the parts of a scene that the scene reader itself reads.
#pragma once

#include <vector>

#include "renderer/api/registry.h"
#include "renderer/api/type_doc.h"

namespace rondure {

// "scene", "sampling", and "object": the keys that every object takes besides its family's.
const std::vector<TypeDoc>& scene_docs();

// Types of one kind, such as all materials.
struct TypeGroup {
  std::string kind;  // "material"
  std::vector<TypeDoc> types;
};

// Everything that a scene can name, in the order in which `rondure list` prints it.
std::vector<TypeGroup> all_types(const Registry& registry);

}  // namespace rondure
