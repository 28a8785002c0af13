#include "renderer/scene/scene_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/plugin/builtin.h"
#include "tests/catch.h"
#include "tests/process.h"
#include "tests/scene/messages.h"

namespace rondure {
namespace {

Scene read(const std::string& text, const SceneOverrides& overrides = {}) {
  Registry registry;
  register_builtins(registry);
  return read_scene_text("s.json", text, registry, overrides);
}

const std::string ball = "\"objects\": [ { \"type\": \"sphere\" } ]";

TEST_CASE("a scene of one object gets everything else by default", "[scene]") {
  const Scene scene = read("{" + ball + "}");
  CHECK(scene.path == "s.json");
  CHECK(scene.film.width == 640);
  CHECK(scene.film.height == 480);
  CHECK(scene.film.filter.kind() == FilterKind::blackman_harris);
  CHECK(scene.sampling.spp == 64);
  CHECK(scene.sampling.seed == 1);
  CHECK(scene.integrator_name == "path");
  CHECK(scene.integrator != nullptr);
  REQUIRE(scene.materials.size() == 1);
  CHECK(std::holds_alternative<Diffuse>(scene.materials[0].scattering));
  REQUIRE(scene.lights.size() == 1);
  REQUIRE(std::holds_alternative<ConstantLight>(scene.lights[0]));
  CHECK(std::get<ConstantLight>(scene.lights[0]).radiance == dvec3(1));
  REQUIRE(scene.objects.size() == 1);
  CHECK(scene.objects[0].name == "objects[0]");
  CHECK(scene.objects[0].type == "sphere");
  CHECK(scene.objects[0].material == 0);
  CHECK(scene.objects[0].traced.solver == Solver::newton);
}

// There is a camera though doubles cannot tell it from its target: rays may be traced all the same.
TEST_CASE("the default camera looks the same way however far the scene is", "[scene]") {
  const dvec3 usual = read(R"({ "objects": [ { "type": "sphere_tiling" } ] })").camera.forward;
  for (const char* place :
       {R"("center": [1e30, 1e30, 0])", R"("center": [1, 1, 1], "radius": 1e-20)",
        R"("center": [0, 0, 1e30])", R"("center": [1e90, -1e90, 1e90], "radius": 1e-90)"}) {
    const Camera camera =
        read(fmt::format(R"({{ "objects": [ {{ "type": "sphere_tiling", {} }} ] }})", place)).camera;
    CAPTURE(place);
    CHECK(glm::distance(camera.forward, usual) < 1e-12);
  }
}

TEST_CASE("the default camera holds every object, wherever and however large", "[scene]") {
  for (const char* film : {"[640, 480]", "[100, 400]"}) {
    for (const char* object :
         {"\"type\": \"sphere\"", "\"type\": \"sphere\", \"center\": [1e5, -3, 7], \"radius\": 1e-3",
          "\"type\": \"sphere_tiling\", \"radius\": 1e4, \"transform\": [{\"scale\": [1, 5, 0.1]}]"}) {
      CAPTURE(film, object);
      const Scene scene = read(
          fmt::format("{{ \"film\": {{ \"resolution\": {} }}, \"objects\": [ {{ {} }} ] }}", film, object));
      const Surface& surface = scene.objects[0].traced.surface;
      std::vector<dvec3> points;
      if (surface.ellipsoid) {
        for (int i = 0; i < 3; ++i) {
          points.push_back(surface.origin + (*surface.ellipsoid)[i]);
          points.push_back(surface.origin - (*surface.ellipsoid)[i]);
        }
      }
      for (const Net& net : surface.patches) {
        for (const dvec4& p : points_of(net)) points.push_back(surface.origin + dvec3(p) / p.w);
      }
      const Camera& camera = scene.camera;
      const double aspect = static_cast<double>(scene.film.width) / scene.film.height;
      int outside = 0;
      double widest = 0.0;
      for (const dvec3& point : points) {
        const dvec3 d = point - camera.origin;
        const double depth = glm::dot(d, camera.forward);
        const double x = glm::dot(d, camera.right) / depth / (0.5 * camera.extent * aspect);
        const double y = glm::dot(d, camera.up) / depth / (0.5 * camera.extent);
        const double reach = std::fmax(std::fabs(x), std::fabs(y));
        outside += !(depth > 0.0 && reach <= 1.0);
        widest = std::fmax(widest, reach);
      }
      CHECK(outside == 0);
      CHECK(widest > 0.3);  // and fills a good part of the picture
    }
  }
}

TEST_CASE("materials are found by name, and the default one is added once", "[scene]") {
  const Scene scene =
      read(R"({ "materials": { "a": {}, "b": { "type": "mirror" }, "": { "type": "dielectric" } },
      "objects": [ { "type": "sphere", "material": "b" }, { "type": "sphere" }, { "type": "sphere", "name": "third" },
                   { "type": "sphere", "material": "" }, { "type": "sphere", "material": "a" } ] })");
  REQUIRE(scene.materials.size() == 4);
  CHECK(std::holds_alternative<Mirror>(scene.materials[1].scattering));
  CHECK(std::holds_alternative<Dielectric>(scene.materials[2].scattering));
  const int expected[] = {1, 3, 3, 2, 0};
  for (std::size_t i = 0; i < 5; ++i) CHECK(scene.objects[i].material == expected[i]);
  CHECK(scene.objects[2].name == "third");
}

TEST_CASE("a light is added only where there would be none", "[scene]") {
  const std::string emitter = "\"materials\": { \"lamp\": { \"emission\": 3 } }";
  CHECK(read("{ \"lights\": []," + ball + "}").lights.size() == 1);
  CHECK(read("{ \"lights\": [ { \"type\": \"point\", \"position\": [0, 0, 5] }, {} ]," + ball + "}")
            .lights.size() == 2);
  CHECK(read("{" + emitter + "," + ball + "}").lights.size() == 1);  // no object has it
  CHECK(read("{" + emitter + ", \"objects\": [ { \"type\": \"sphere\", \"material\": \"lamp\" } ] }")
            .lights.empty());
}

TEST_CASE("the integrator is a name or an object", "[scene]") {
  CHECK(read("{ \"integrator\": \"normals\", " + ball + "}").integrator_name == "normals");
  CHECK(read("{ \"integrator\": { \"type\": \"path\", \"max_depth\": 3 }, " + ball + "}").integrator_name ==
        "path");
}

TEST_CASE("the hash tells files and overrides apart", "[scene]") {
  const std::string text = "{" + ball + "}";
  const std::uint64_t plain = read(text).hash;
  CHECK(plain == read(text).hash);
  CHECK(plain != read(text + " ").hash);
  std::vector<SceneOverrides> all(8);
  all[0].set = {"/sampling/spp=3"};
  all[1].spp = 3;
  all[2].seed = 3;
  all[3].resolution = {3, 3};
  all[4].integrator = "direct";
  all[5].solver = "clipping";
  all[6].normals = "cross";
  all[7].layers = {"jacobian"};
  std::vector<std::uint64_t> hashes = {plain};
  for (const SceneOverrides& overrides : all) {
    const std::uint64_t hash = read(text, overrides).hash;
    CHECK(std::count(hashes.begin(), hashes.end(), hash) == 0);
    hashes.push_back(hash);
  }
  CHECK(plain == 0x6DAC60F2F10C8594u);  // FNV-1a, computed apart
  // The file's name is no part of it.
  Registry registry;
  register_builtins(registry);
  CHECK(read_scene_text("other.json", text, registry).hash == plain);
}

TEST_CASE("overrides change what they name", "[scene]") {
  SceneOverrides overrides;
  overrides.set = {"/objects/0/radius=2.5",
                   "/objects/0/center=[1, 2, 3]",
                   "/objects/0/name=big ball",
                   "/camera/origin=[0,-9,0]",
                   "/materials/a~1b~0c/albedo=0.25",
                   "/objects/0/material=a/b~c",
                   "/sampling/seed=5",
                   "/sampling/seed=6"};
  overrides.spp = 7;
  overrides.resolution = {32, 16};
  overrides.integrator = "normals";
  overrides.solver = "clipping";
  overrides.normals = "taylor";
  const Scene scene = read("{" + ball + "}", overrides);
  CHECK((*scene.objects[0].traced.surface.ellipsoid)[0] == dvec3(2.5, 0, 0));
  CHECK(scene.objects[0].traced.surface.origin == dvec3(1, 2, 3));
  CHECK(scene.objects[0].name == "big ball");
  CHECK(scene.camera.origin == dvec3(0, -9, 0));
  CHECK(std::get<Diffuse>(scene.materials[0].scattering).albedo == dvec3(0.25));
  CHECK(scene.sampling.seed == 6);
  CHECK(scene.sampling.spp == 7);
  CHECK(scene.film.width == 32);
  CHECK(scene.film.height == 16);
  CHECK(scene.integrator_name == "normals");
  CHECK(scene.objects[0].traced.solver == Solver::clipping);
  CHECK(scene.objects[0].normals == NormalEstimator::taylor);
}

TEST_CASE("an integrator named again keeps its parameters", "[scene]") {
  SceneOverrides overrides;
  overrides.integrator = "path";
  const std::string wrong = "{ \"integrator\": { \"type\": \"path\", \"max_depth\": -1 }, " + ball + "}";
  CHECK(first_line(message_of([&] { read(wrong, overrides); })) ==
        "s.json:1:48: \"max_depth\" must be an integer in [0, 100000], found -1");
  overrides.integrator = "normals";
  CHECK(message_of([&] { read(wrong, overrides); }) == "accepted");
}

TEST_CASE("overrides that cannot be applied say which", "[scene]") {
  const std::pair<const char*, const char*> table[] = {
      {"", "--set takes /json/pointer=value, such as /sampling/spp=16, found \"\""},
      {"spp=3", "--set takes /json/pointer=value, such as /sampling/spp=16, found \"spp=3\""},
      {"/spp", "--set takes /json/pointer=value, such as /sampling/spp=16, found \"/spp\""},
      {"/=3", "--set takes /json/pointer=value, such as /sampling/spp=16, found \"/=3\""},
      {"/objects/1/radius=3", "--set /objects/1/radius: \"1\" is not an element of the array, which has 1"},
      {"/objects/00/radius=3",
       "--set /objects/00/radius: \"00\" is not an element of the array, which has 1"},
      {"/objects/-/radius=3", "--set /objects/-/radius: \"-\" is not an element of the array, which has 1"},
      {"/objects/0/type/x=3", "--set /objects/0/type/x: \"/objects/0/type\" is a string, not an object"},
      {"/a~2b=3", "--set /a~2b: after \"~\" must stand 0 or 1"},
      {"/smpling/spp=3",
       "s.json: unknown key \"smpling\" in the scene; did you mean \"sampling\"? (set on the command line)"},
      {"/objects/0/radius=big",
       "s.json: objects[0]: \"radius\" must be a number greater than 0, found \"big\" (set on the command "
       "line)"},
      {"/objects/0/radius=[1", "--set:1:1: this array is never closed\n  1 | [1\n    | ^"},
      {"/film={\"filter\":\"box\",\"filter\":\"tent\"}",
       "--set:1:17: key \"filter\" stands twice in this object; the first is at line 1, column 2\n"
       "  1 | {\"filter\":\"box\",\"filter\":\"tent\"}\n"
       "    |                 ^"},
      {"/objects/0/solver=exact",
       "s.json: objects[0]: \"solver\" must be one of \"auto\", \"newton\", \"clipping\", \"radial\", "
       "\"quadric\", found \"exact\" "
       "(set on the "
       "command line)"},
      {"/objects/0/colour=3",
       "s.json: unknown key \"colour\" in objects[0]; known keys: \"center\", \"isolines\", \"material\", "
       "\"name\", \"normals\", "
       "\"radius\", "
       "\"show\", \"solver\", \"transform\", \"type\", \"wire\", \"wire_material\" (set on the command "
       "line)"},
  };
  for (const auto& [set, message] : table) {
    SceneOverrides overrides;
    overrides.set = {set};
    CAPTURE(set);
    CHECK(message_of([&] { read("{" + ball + "}", overrides); }) == message);
  }
  SceneOverrides spp;
  spp.spp = 0;
  CHECK(message_of([&] { read("{" + ball + "}", spp); }) ==
        "s.json: sampling: \"spp\" must be an integer in [1, 1073741824], found 0 (set on the command line)");
}

TEST_CASE("files of a scene are found beside it", "[scene]") {
  const std::string folder = fresh_folder("scene_reader");
  write_text_file(folder + "/square.json", R"({ "patches": [ { "kind": "tensor", "degree": [1, 1],
      "net": [[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[1,1,0,1]]] } ] })");
  write_text_file(folder + "/scene.json",
                  R"({ "objects": [ { "type": "bezier", "file": "square.json" } ] })");
  Registry registry;
  register_builtins(registry);
  CHECK(read_scene(folder + "/scene.json", registry).objects[0].traced.surface.patches.size() == 1);
}

}  // namespace
}  // namespace rondure
