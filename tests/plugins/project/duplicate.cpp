// Takes a name that is taken.
#include "renderer/api/registry.h"

namespace rondure {

void register_duplicate(Registry& registry) {
  registry.add(SurfaceFamily{"newcomer", "must not stay", {}, [](Params&) { return Surface(); }});
  registry.add(SurfaceFamily{"sphere", "not the sphere", {}, [](Params&) { return Surface(); }});
}

}  // namespace rondure
