// Every form and every limit of what a scene has beside its objects, by the schema and by the reader.
#include "tests/catch.h"
#include "tests/render/staged_scene.h"
#include "tests/scene/schema.h"

namespace rondure {
namespace {

TEST_CASE("schema and reader agree on every form and every limit beside the objects", "[scene]") {
  const std::vector<SchemaRow> rows = {
      {true, "/name", "\"x\""},
      {false, "/name", "1"},
      {true, "/comment", "\"x\""},
      {false, "/comments", "\"x\""},
      {true, "/camera", "{}"},
      {false, "/camera", "[]"},
      {false, "/camera", "null"},
      {true, "/camera", R"({"fov": 179, "aperture": 0, "focus_distance": 0.1, "up": [0, 1, 0]})"},
      {false, "/camera", R"({"fov": 180})"},
      {false, "/camera", R"({"fov": 0})"},
      {false, "/camera", R"({"aperture": -0.1})"},
      {false, "/camera", R"({"focus_distance": 0})"},
      {false, "/camera", R"({"origin": [0, 1]})"},
      {false, "/camera", R"({"origin": [0, 1, 2, 3]})"},
      {true, "/camera", R"({"type": "orthographic"})"},
      {true, "/camera", R"({"type": "orthographic", "height": 3})"},
      {false, "/camera", R"({"type": "orthographic", "height": 0})"},
      {false, "/camera", R"({"height": 3})"},
      {false, "/camera", R"({"type": "orthographic", "fov": 30})"},
      {false, "/camera", R"({"type": "orthographic", "aperture": 0.1})"},
      {true, "/film", "{}"},
      {true, "/film", R"({"resolution": [65536, 1], "filter": "tent"})"},
      {false, "/film", R"({"resolution": [65537, 1]})"},
      {false, "/film", R"({"resolution": [0, 1]})"},
      {false, "/film", R"({"resolution": [1.5, 1]})"},
      {false, "/film", R"({"resolution": [4]})"},
      {false, "/film", R"({"resolution": [4, 4, 4]})"},
      {false, "/film", R"({"filter": "lanczos"})"},
      {true, "/film", R"({"filter": {}})"},
      {true, "/film", R"({"filter": {"type": "gaussian", "radius": 16}})"},
      {false, "/film", R"({"filter": {"radius": 16.5}})"},
      {false, "/film", R"({"filter": {"radius": -1}})"},
      {false, "/film", R"({"filter": {"width": 1}})"},
      {true, "/film", R"({"layers": []})"},
      {true, "/film", R"({"layers": ["jacobian", {"type": "jacobian", "as": "J2"}]})"},
      {true, "/film",
       R"({"layers": [{"type": "highlight_lines", "position": [0, 0, 3], "step": [0.1, 0, 0], "direction": [0, 1, 0]}]})"},
      {false, "/film", R"({"layers": [{"type": "highlight_lines", "position": [0, 0, 3]}]})"},
      {false, "/film", R"({"layers": [{"type": "reflection_lines", "step": [0, 0, 3]}]})"},
      {false, "/film", R"({"layers": [{"type": "isophotes", "position": [0, 0, 3], "step": [0.1, 0, 0]}]})"},
      {false, "/film", R"({"layers": "jacobian"})"},
      {false, "/film", R"({"layers": [1]})"},
      {false, "/film", R"({"layers": [{}]})"},
      {false, "/film", R"({"layers": [{"type": "jacobian", "as": ""}]})"},
      {false, "/film", R"({"layers": [{"type": "jacobian", "as": "a.b"}]})"},
      {false, "/film", R"({"layers": [{"type": "jacobian", "of": "u"}]})"},
      {true, "/sampling", "{}"},
      {true, "/sampling", R"({"spp": 1, "seed": 0})"},
      {true, "/sampling", R"({"spp": 1073741824, "seed": 9007199254740991})"},
      {false, "/sampling", R"({"spp": 0})"},
      {false, "/sampling", R"({"spp": 1073741825})"},
      {false, "/sampling", R"({"seed": -1})"},
      {false, "/sampling", R"({"spp": 1.5})"},
      {true, "/integrator", "\"path\""},
      {true, "/integrator", "\"direct\""},
      {true, "/integrator", "\"normals\""},
      {false, "/integrator", "{}"},
      {true, "/integrator", R"({"type": "path"})"},
      {true, "/integrator", R"({"type": "path", "max_depth": 0, "min_depth": 100000})"},
      {false, "/integrator", R"({"type": "path", "max_depth": 100001})"},
      {false, "/integrator", R"({"type": "path", "max_depth": -1})"},
      {true, "/integrator", R"({"type": "direct", "max_depth": 1})"},
      {false, "/integrator", R"({"type": "direct", "min_depth": 1})"},
      {false, "/integrator", R"({"type": "normals", "max_depth": 1})"},
      {true, "/materials", "{}"},
      {true, "/materials/a", R"({"isolines": {}})"},
      {true, "/materials/a", R"({"type": "mirror", "isolines": {"count": 1, "width": 0, "albedo": 1}})"},
      {true, "/materials/a", R"({"isolines": {"count": 1000, "boundary_width": 0.1}})"},
      {false, "/materials/a", R"({"isolines": true})"},
      {false, "/materials/a", R"({"isolines": {"count": 0}})"},
      {false, "/materials/a", R"({"isolines": {"count": 1001}})"},
      {false, "/materials/a", R"({"isolines": {"width": -1}})"},
      {false, "/materials/a", R"({"isolines": {"albedo": 1.5}})"},
      {false, "/materials/a", R"({"isolines": {"lines": 3}})"},
      {true, "/materials/a", R"({"curvature": {}})"},
      {true, "/materials/a", R"({"type": "diffuse", "curvature": {"of": "mean", "range": [-2.5, -0.5]}})"},
      {true, "/materials/a", R"({"curvature": {"of": "gaussian"}, "isolines": {}, "albedo": 0.2})"},
      {false, "/materials/a", R"({"curvature": "mean"})"},
      {false, "/materials/a", R"({"curvature": {"of": "normal"}})"},
      {false, "/materials/a", R"({"curvature": {"range": 1}})"},
      {false, "/materials/a", R"({"curvature": {"range": [0, 1, 2]}})"},
      {false, "/materials/a", R"({"curvature": {"kind": "mean"}})"},
      {false, "/materials/a", R"({"type": "mirror", "curvature": {}})"},
      {false, "/materials/a", R"({"type": "dielectric", "curvature": {}})"},
      {false, "/materials/a", R"({"type": "rough_conductor", "curvature": {}})"},
      {true, "/materials/a", "{}"},
      {false, "/materials/a", "\"diffuse\""},
      {true, "/materials/a", R"({"albedo": 1, "emission": 5})"},
      {true, "/materials/a", R"({"albedo": [0, 0.5, 1], "emission": [1, 2, 3]})"},
      {false, "/materials/a", R"({"albedo": 1.1})"},
      {false, "/materials/a", R"({"albedo": [0, 0, -0.1]})"},
      {false, "/materials/a", R"({"albedo": [0, 0]})"},
      {false, "/materials/a", R"({"emission": -1})"},
      {false, "/materials/a", R"({"reflectance": 1})"},
      {false, "/materials/a", R"({"type": "plastic"})"},
      {true, "/materials/a", R"({"type": "mirror", "reflectance": 0.5})"},
      {false, "/materials/a", R"({"type": "mirror", "reflectance": 1.5})"},
      {true, "/materials/a", R"({"type": "dielectric", "ior": 0.1, "transmittance": 0.5, "emission": 1})"},
      {true, "/materials/a", R"({"type": "dielectric", "ior": 10})"},
      {false, "/materials/a", R"({"type": "dielectric", "ior": 10.1})"},
      {false, "/materials/a", R"({"type": "dielectric", "ior": 0.09})"},
      {false, "/materials/a", R"({"type": "dielectric", "albedo": 1})"},
      {true, "/materials/a", R"({"type": "rough_conductor", "eta": 1, "k": 0, "roughness": 0.01})"},
      {false, "/materials/a", R"({"type": "rough_conductor", "eta": 0})"},
      {false, "/materials/a", R"({"type": "rough_conductor", "eta": [1, 1, 0]})"},
      {false, "/materials/a", R"({"type": "rough_conductor", "roughness": 0.009})"},
      {false, "/materials/a", R"({"type": "rough_conductor", "roughness": 1.1})"},
      {true, "/lights", "[]"},
      {false, "/lights", "{}"},
      {true, "/lights", "[{}]"},
      {true, "/lights", R"([{"type": "constant", "radiance": 0.5}, {"radiance": [1, 2, 3]}])"},
      {false, "/lights", R"([{"type": "constant", "intensity": 0.5}])"},
      {true, "/lights", R"([{"type": "point", "position": [1, 2, 3], "intensity": 5}])"},
      {false, "/lights", R"([{"type": "point"}])"},
      {false, "/lights", R"([{"position": [1, 2, 3]}])"},
      {true, "/lights", R"([{"type": "directional", "direction": [1, 2, 3], "irradiance": 5}])"},
      {true, "/lights", R"([{"type": "directional"}])"},
      {false, "/lights", R"([{"type": "directional", "irradiance": -5}])"},
      {false, "/lights", R"([{"type": "environment"}])"},
      {false, "/lights", R"([{"type": "environment", "file": ""}])"},
      {true, "/lights", R"([{"type": "environment", "file": "showcase.json", "scale": 2, "rotate": 90}])"},
      {true, "/lights", R"([{"type": "environment", "file": "showcase.json", "rotate": [1, 2, 3]}])"},
      {false, "/lights", R"([{"type": "environment", "file": "showcase.json", "rotate": "x"}])"},
      {true, "/normals", "\"taylor\""},
      {false, "/normals", "\"\""},
  };
  check_rows(rows, StagedScene::builtins());
}

TEST_CASE("the schema leaves a plugin's types to the plugin, and no others", "[scene]") {
  // A family and an integrator that are as good as a plugin's; each takes the key "size".
  Registry registry;
  register_builtins(registry);
  SurfaceFamily family = *registry.family("sphere");
  family.name = "pebble";
  family.build = [inner = family.build](Params& params) {
    params.number("size", 1.0, {});
    return inner(params);
  };
  registry.add(family);
  IntegratorFactory factory = *registry.integrator("normals");
  factory.name = "glow";
  factory.create = [inner = factory.create](Params& params) {
    params.number("size", 1.0, {});
    return inner(params);
  };
  registry.add(factory);
  const std::vector<SchemaRow> rows = {
      {true, "/objects/0", R"({"type": "pebble", "size": 3})"},
      {true, "/objects/0", R"({"type": "pebble", "size": 3, "radius": 2, "center": [0, 0, 1], "name": "p"})"},
      {false, "/objects/0", R"({"type": "pebble", "size": 3, "radius": -2})"},
      {false, "/objects/0", R"({"type": "pebble", "solver": "none"})"},
      {false, "/objects/0", R"({"type": "pebble", "transform": 1})"},
      {false, "/objects/0", R"({"type": ["pebble"]})"},
      {false, "/objects/0", R"({"size": 3})"},
      {false, "/objects/0", R"({"type": "sphere", "size": 3})"},
      {false, "/objects/0", R"({"type": "sphere_cap", "z_max": 2})"},
      {true, "/integrator", "\"glow\""},
      {true, "/integrator", R"({"type": "glow", "size": 3})"},
      {false, "/integrator", R"({"type": 3})"},
      {false, "/integrator", R"({"size": 3})"},
      {false, "/integrator", R"({"type": "path", "size": 3})"},
      {false, "/materials/a", R"({"type": "pebble"})"},
      {false, "/lights", R"([{"type": "pebble"}])"},
      {false, "/camera", R"({"type": "pebble"})"},
  };
  check_rows(rows, registry);
}

}  // namespace
}  // namespace rondure
