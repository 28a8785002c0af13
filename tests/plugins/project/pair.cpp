// Two families in one plugin.
#include "renderer/api/registry.h"

namespace rondure {

void register_left(Registry& registry) {
  registry.add(SurfaceFamily{"left", "one of a pair", {}, [](Params&) { return Surface(); }});
}

void register_right(Registry& registry) {
  registry.add(SurfaceFamily{"right", "one of a pair", {}, [](Params&) { return Surface(); }});
}

}  // namespace rondure
