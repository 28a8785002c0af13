// The families, integrators and layers that are compiled in.
#pragma once

#include "renderer/api/registry.h"

namespace rondure {

void register_builtins(Registry& registry);

}  // namespace rondure
