#include "renderer/scene/object_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "renderer/api/utf8.h"
#include "renderer/bezier/transform.h"
#include "renderer/continuity/seams.h"
#include "renderer/intersect/ellipsoid.h"
#include "renderer/intersect/ellipsoid_fit.h"
#include "renderer/intersect/local_ray.h"
#include "renderer/intersect/radial.h"
#include "renderer/plugin/build_surface.h"
#include "renderer/scene/show.h"
#include "renderer/scene/transform_reader.h"
#include "renderer/scene/unknown_name.h"

namespace rondure {
namespace {

constexpr const char* way_out = "take a family of patches, such as \"sphere_tiling\"";

void transform_all(Surface& surface, const dmat4& map) {
  if (mirrors(map)) {
    const auto turn = [&](int patch, int& side) {
      side = reversed_side(side_count(surface.patches[static_cast<std::size_t>(patch)]), side);
    };
    for (SideJoin& join : surface.joins) turn(join.patch, join.side), turn(join.other, join.other_side);
  }
  for (Net& net : surface.patches) net = transformed(net, map);
  for (auto& [part, guides] : surface.guides) {
    for (Guide& guide : guides) {
      for (dvec4& p : guide.curve) p = map * p;
    }
  }
}

// Whether a column is infinite or next to none, as those of steps that multiply to it may be.
bool leaves_numbers(const dmat3& map) {
  for (int j = 0; j < 3; ++j)
    if (!is_finite(map[j]) || largest(map[j]) < std::numeric_limits<double>::min()) return true;
  return false;
}

void place_affine(Surface& surface, const Placement& placement) {
  const dmat3 map(placement.transform);
  const dmat3 linear = map * placement.radius;
  if (leaves_numbers(linear))
    throw std::invalid_argument("its radius and transform multiply to a size that no number has");
  surface.origin =
      map * (placement.center + placement.radius * surface.origin) + dvec3(placement.transform[3]);
  if (linear == dmat3(1.0)) return;
  if (surface.ellipsoid) {
    *surface.ellipsoid = linear * *surface.ellipsoid;
    if (is_too_flat(*surface.ellipsoid))
      throw std::invalid_argument(fmt::format("the closed form bears semi-axes in a ratio up to {:.0e}; {}",
                                              flattest_ellipsoid, way_out));
  }
  transform_all(surface, dmat4(linear));
}

void place_projective(Surface& surface, const Placement& placement) {
  if (surface.ellipsoid)
    throw std::invalid_argument(
        fmt::format("a projective transform does not keep an analytic sphere analytic; {}", way_out));
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
  transform_all(surface, map);
}

// Homogeneous points may change sign together: the surface is the same, and solvers want positive weights.
void make_corner_positive(Net& net) {
  std::vector<dvec4>& points = points_of(net);
  if (points.front().w >= 0.0) return;
  for (dvec4& p : points) p = -p;
}

int read_material_name(Params& params, const char* key, int otherwise,
                       const std::map<std::string, int>& materials) {
  const Value* value = params.raw(key);
  if (!value) return otherwise;
  const std::string name = params.text(key);
  const auto found = materials.find(name);
  if (found != materials.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [known, index] : materials) names.push_back(known);
  params.fail(*value, unknown_name("material", name, names));
}

// "auto" and those that only some patches allow become what the surface allows.
Solver solver_named(const std::string& name, const Surface& surface) {
  if (name == "clipping") return Solver::clipping;
  const auto is = [&](const char* solver) { return name == solver || name == "auto"; };
  if (is("radial") && std::any_of(surface.patches.begin(), surface.patches.end(), has_radial_form))
    return Solver::radial;
  if (is("quadric") && !fit_ellipsoids(surface.patches).empty()) return Solver::quadric;
  return Solver::newton;
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

NormalEstimator read_estimator(Params& params, std::string_view key) {
  const std::string name = params.choice(
      key, {"limit", "cross", "cross_float", "taylor", "shift", "hodograph", "analytic"}, "limit");
  return *estimator_named(name);
}

std::vector<SceneObject> read_object(Params& params, const Registry& registry,
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
  object.material = read_material_name(params, "material", default_material, materials);
  const std::string solver =
      params.choice("solver", {"auto", "newton", "clipping", "radial", "quadric"}, "auto");
  if (params.raw("normals")) object.normals = read_estimator(params, "normals");
  object.traced.surface = build_surface(family, params);
  const Show show = read_show(params, object.traced.surface);
  const int wire_material = read_material_name(params, "wire_material", contrast_material, materials);
  params.finish();
  try {
    place(object.traced.surface, placement);
  } catch (const std::invalid_argument& error) {
    const char* key = params.raw("transform") ? "transform" : "radius";
    params.fail(key, fmt::format("\"{}\": {}", printable(object.type), error.what()));
  }
  ShownParts parts = shown_parts(params, show, object.traced.surface);
  std::vector<SceneObject> objects;
  if (parts.surface) {
    objects.push_back(object);
    objects.back().traced.surface = std::move(*parts.surface);
  }
  if (parts.wires) {
    object.traced.surface = std::move(*parts.wires);
    if (parts.surface) object.name += ", wires";
    // Alone, wires are the object; "material" is theirs too.
    if (parts.surface || wire_material != contrast_material) object.material = wire_material;
    objects.push_back(std::move(object));
  }
  for (SceneObject& each : objects) each.traced.solver = solver_named(solver, each.traced.surface);
  return objects;
}

}  // namespace rondure
