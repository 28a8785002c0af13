// The built-in integrators, one function a file; the host's table calls each by name.
#pragma once

#include "renderer/api/registry.h"

namespace rondure {

void register_path(Registry& registry);
void register_direct(Registry& registry);
void register_normals(Registry& registry);
void register_study(Registry& registry);

}  // namespace rondure
