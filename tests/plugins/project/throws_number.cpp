// Throws something that says nothing of itself.
#include "renderer/api/registry.h"

namespace rondure {

void register_throws_number(Registry&) { throw 42; }

}  // namespace rondure
