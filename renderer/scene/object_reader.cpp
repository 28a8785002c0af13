#include "renderer/scene/object_reader.h"

#include <fmt/format.h>

#include <stdexcept>

#include "renderer/api/utf8.h"
#include "renderer/bezier/transform.h"
#include "renderer/scene/transform_reader.h"
#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

void place_affine(Surface& surface, const Placement& placement) {
  const dmat3 map(placement.transform);
  const dmat3 linear = map * placement.radius;
  surface.origin =
      map * (placement.center + placement.radius * surface.origin) + dvec3(placement.transform[3]);
  if (linear == dmat3(1.0)) return;
  if (surface.ellipsoid) *surface.ellipsoid = linear * *surface.ellipsoid;
  for (Net& net : surface.patches) net = transformed(net, dmat4(linear));
}

void place_projective(Surface& surface, const Placement& placement) {
  if (surface.ellipsoid)
    throw std::invalid_argument("a projective transform does not keep an analytic sphere analytic");
  dmat4 frame(placement.radius);
  frame[3] = dvec4(placement.center + placement.radius * surface.origin, 1.0);
  dmat4 map = placement.transform * frame;
  // The world's place of the old origin becomes the new one, unless it went to infinity.
  surface.origin = dvec3(0.0);
  if (map[3].w != 0.0) {
    surface.origin = dvec3(map[3]) / map[3].w;
    for (int j = 0; j < 4; ++j) map[j] -= dvec4(surface.origin * map[j].w, 0.0);
    map[3] = dvec4(0.0, 0.0, 0.0, map[3].w);
  }
  for (Net& net : surface.patches) net = transformed(net, map);
}

// Homogeneous points may change sign together: the surface is the same, and solvers want positive weights.
void make_corner_positive(Net& net) {
  std::vector<dvec4>& points = points_of(net);
  if (points.front().w >= 0.0) return;
  for (dvec4& p : points) p = -p;
}

int read_material_name(Params& params, const std::map<std::string, int>& materials) {
  const Value* value = params.raw("material");
  if (!value) return default_material;
  const std::string name = params.text("material");
  const auto found = materials.find(name);
  if (found != materials.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [known, index] : materials) names.push_back(known);
  params.fail(*value, unknown_name("material", name, names));
}

}  // namespace

void place(Surface& surface, const Placement& placement) {
  if (is_affine(placement.transform)) {
    place_affine(surface, placement);
  } else {
    place_projective(surface, placement);
  }
  for (Net& net : surface.patches) make_corner_positive(net);
}

SceneObject read_object(Params& params, const Registry& registry,
                        const std::map<std::string, int>& materials) {
  SceneObject object;
  object.where = params.where();
  const SurfaceFamily& family = family_of(params, registry);
  object.type = family.name;
  params.set_registry(registry);
  object.name = params.text("name", params.what());
  Placement placement;
  placement.center = params.vec3("center", placement.center);
  placement.radius = params.number("radius", placement.radius, Range::positive());
  placement.transform = read_transform(params);
  object.material = read_material_name(params, materials);
  object.traced.solver = params.choice("solver", {"newton", "clipping"}, "newton") == "clipping"
                             ? Solver::clipping
                             : Solver::newton;
  object.traced.surface = family.build(params);
  params.finish();
  try {
    place(object.traced.surface, placement);
  } catch (const std::invalid_argument& error) {
    params.fail("transform", fmt::format("\"{}\": {}; take a family of patches, such as \"sphere_tiling\"",
                                         printable(object.type), error.what()));
  }
  return object;
}

}  // namespace rondure
