#include "renderer/api/registry.h"

namespace rondure {

void register_bad_name(Registry& registry) {
  registry.add(SurfaceFamily{
      "\x1b[2Jsphere", "a name that would clear the screen", {}, [](Params&) { return Surface(); }});
}

}  // namespace rondure
