// Surfaces for the ray tests, built by their families from scene text.
#pragma once

#include <string>

#include "renderer/api/surface.h"
#include "renderer/plugin/builtin.h"
#include "renderer/scene/json_reader.h"

namespace rondure {

// `object`: what would stand in a scene's "objects", host keys aside.
inline Surface family_surface(const std::string& object) {
  Registry registry;
  register_builtins(registry);
  const Document document = read_json_text("test", object);
  Params params(document.root, document.source.get(), "object");
  const SurfaceFamily* family = registry.family(params.text("type"));
  Surface surface = family->build(params);
  params.finish();
  return surface;
}

// The unit-size surface, scaled and moved.
inline Surface placed(Surface surface, double radius, const dvec3& center) {
  for (Net& net : surface.patches)
    for (dvec4& p : points_of(net)) p = dvec4(radius * dvec3(p), p.w);
  if (surface.ellipsoid) *surface.ellipsoid *= radius;
  surface.origin = center;
  return surface;
}

}  // namespace rondure
