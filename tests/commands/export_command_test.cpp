// rondure export: what is written is what rays meet.
#include "renderer/plugin/builtin.h"
#include "renderer/scene/scene_reader.h"
#include "tests/catch.h"
#include "tests/commands/command_files.h"

namespace rondure {
namespace {

const std::string scene = R"({ "objects": [
  { "type": "sphere_tiling", "topology": "cube", "center": [1e5, -0.3, 7], "radius": 0.37, "name": "a \"b\"" },
  { "type": "sphere", "center": [3, 1, 2], "radius": 2, "transform": [ { "rotate": { "axis": [1, 2, 3], "angle": 30 } } ] },
  { "type": "circular_triangle", "corners": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "transform": [[1, 0.2, 0, 3], [0, 1.1, 0, 0], [0.3, 0, 1, 0], [0.01, 0, 0, 1]] },
  { "type": "iss", "octants": { "degree": 3, "interior": 1 } } ] })";

Scene read(const std::string& text) {
  Registry registry;
  register_builtins(registry);
  return read_scene_text("s.json", text, registry);
}

ProcessResult exported(const std::string& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"export", "scene.json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  ProcessOptions options;
  options.folder = folder;
  return run_rondure(arguments, options);
}

}  // namespace

TEST_CASE("an exported scene has the nets of its source, bit by bit", "[command][export]") {
  const std::string folder = folder_with("export", scene);
  const ProcessResult result = exported(folder, {});
  REQUIRE(result.exit_code == 0);
  const Scene given = read(scene), back = read(result.out);
  REQUIRE(back.objects.size() == given.objects.size());
  std::size_t nets = 0;
  for (std::size_t k = 0; k < given.objects.size(); ++k) {
    const Surface &a = given.objects[k].traced.surface, &b = back.objects[k].traced.surface;
    INFO(k);
    CHECK(back.objects[k].name == given.objects[k].name);
    CHECK(a.closed == b.closed);
    CHECK(a.origin == b.origin);
    CHECK(a.ellipsoid == b.ellipsoid);
    REQUIRE(a.patches.size() == b.patches.size());
    for (std::size_t j = 0; j < a.patches.size(); ++j, ++nets) {
      CHECK(a.patches[j].index() == b.patches[j].index());
      CHECK(points_of(a.patches[j]) == points_of(b.patches[j]));
    }
  }
  CHECK(nets == 6 + 1 + 8);
}

TEST_CASE("triangles leave as tensor-product patches where they are asked to", "[command][export]") {
  const std::string folder = folder_with("export_forms", scene);
  for (const auto& [form, count] : {std::pair("degenerate", 8), std::pair("quadrilaterals", 24)}) {
    REQUIRE(exported(folder, {"--form", form, "-o", "out.json"}).exit_code == 0);
    const Scene back = read(read_text_file(folder + "/out.json"));
    const std::vector<Net>& patches = back.objects[3].traced.surface.patches;
    CHECK(static_cast<int>(patches.size()) == count);
    for (const Net& net : patches) CHECK(std::holds_alternative<TensorNet>(net));
  }
  CHECK(exported(folder, {"--form", "quads"}).err.find("unknown form \"quads\"") != std::string::npos);
  CHECK(exported(folder, {"-o", "scene.json"}).err ==
        "rondure: error: scene.json: is the scene and the output at once\n");
  CHECK(read_text_file(folder + "/scene.json") == scene);
}

TEST_CASE("spheres leave as preimages under the generalised projection, and come back", "[command][export]") {
  const std::string folder = folder_with("export_preimage", R"({ "objects": [
    { "type": "sphere_tiling", "topology": "cube_2_4", "center": [4, -0.3, 7], "radius": 0.37, "name": "six" },
    { "type": "circular_triangle", "corners": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
      "transform": [ { "rotate": { "axis": [1, 2, 3], "angle": 30 } } ] } ] })");
  REQUIRE(exported(folder, {"--form", "preimage", "-o", "out.json"}).exit_code == 0);
  const Scene given = read(read_text_file(folder + "/scene.json")),
              back = read(read_text_file(folder + "/out.json"));
  REQUIRE(back.objects.size() == 2);
  double off = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const Surface &a = given.objects[k].traced.surface, &b = back.objects[k].traced.surface;
    CHECK(back.objects[k].type == "projected_net");
    CHECK(back.objects[k].name == given.objects[k].name);
    CHECK(a.origin == b.origin);
    CHECK(a.closed == b.closed);
    REQUIRE(a.patches.size() == b.patches.size());
    for (std::size_t j = 0; j < a.patches.size(); ++j) {
      REQUIRE(points_of(a.patches[j]).size() == points_of(b.patches[j]).size());
      for (std::size_t c = 0; c < points_of(a.patches[j]).size(); ++c) {
        const dvec4 d = points_of(a.patches[j])[c] - points_of(b.patches[j])[c];
        off = std::fmax(off, std::sqrt(glm::dot(d, d)));
      }
    }
  }
  // A preimage is found to ten digits.
  CHECK(off < 1e-9);
}

TEST_CASE("what has no preimage is refused, base points are named", "[command][export]") {
  const auto refused = [](const char* name, const std::string& objects, const std::string& part) {
    const std::string folder = folder_with(name, "{ \"objects\": [" + objects + "] }");
    const ProcessResult result = exported(folder, {"--form", "preimage"});
    INFO(objects << "\n" << result.err);
    CHECK(result.exit_code == 1);
    CHECK(result.err.find(part) != std::string::npos);
    CHECK(result.out.empty());
  };
  refused("preimage_second", R"({ "type": "sphere_tiling" }, { "type": "sphere" })", "is analytic");
  refused("preimage_iss", R"({ "type": "iss", "octants": { "degree": 3, "interior": 1 } })",
          "does not lie on a sphere");
  refused("preimage_analytic", R"({ "type": "sphere" })", "is analytic");
  // The equator's neighbourhood raised to an odd degree.
  refused("preimage_odd", R"({ "type": "bezier", "patches": [ { "kind": "tensor", "degree": [1, 1],
          "net": [ [[1,0,0,1], [1,0,0,1]], [[1,0,0,1], [1,0,0,1]] ] } ] })",
          "odd degree");
  // The image of a = v (1 + i u), b = u, which vanish together at (0, 0).
  refused("preimage_base", R"({ "type": "bezier", "patches": [ { "kind": "tensor", "degree": [2, 2], "net":
          [ [[0,0,0,0], [0,0,0,0], [0,0,1,1]], [[0,0,0,0], [0.5,0,0,0], [1,0,1,1]],
            [[0,0,-1,1], [1,1,-1,1], [2,2,1,3]] ] } ] })",
          "has base points, where the patch is no point: (u, v) = (");
}

}  // namespace rondure
