// The built-in layers, one function a file; the host's table calls each by name.
#pragma once

#include "renderer/api/registry.h"
#include "renderer/shading/world.h"

namespace rondure {

void register_certificate_layer(Registry& registry);
void register_curvature_layer(Registry& registry);
void register_jacobian_layer(Registry& registry);
void register_line_layers(Registry& registry);
void register_normal_error_layer(Registry& registry);
void register_residual_layer(Registry& registry);
void register_work_layer(Registry& registry);

// The net of the patch that was hit; null for a miss, and on an analytic surface, which has none.
inline const Net* net_at(const World& world, const Hit& hit) {
  if (!hit) return nullptr;
  const std::vector<Net>& patches =
      world.tracer().surfaces()[static_cast<std::size_t>(hit.surface)].surface.patches;
  return patches.empty() ? nullptr : &patches[static_cast<std::size_t>(hit.patch)];
}

}  // namespace rondure
