// Fails half-way: what it added before must not stay.
#include <stdexcept>

#include "renderer/api/registry.h"

namespace rondure {

void register_throws(Registry& registry) {
  registry.add(SurfaceFamily{"left_behind", "must not stay", {}, [](Params&) { return Surface(); }});
  throw std::runtime_error("no licence for spheres");
}

}  // namespace rondure
