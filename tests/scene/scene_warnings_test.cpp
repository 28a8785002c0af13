// What is allowed and seldom meant.

#include "renderer/commands/scene_warnings.h"

#include "renderer/scene/coincident_patches.h"
#include "renderer/scene/scene_reader.h"
#include "tests/catch.h"
#include "tests/intersect/boxes.h"
#include "tests/render/staged_scene.h"
#include "tests/surfaces/build_family.h"

namespace rondure {
namespace {

TEST_CASE("a wall that two bodies of one object share is warned of", "[scene]") {
  Surface bricks = box(dvec3(-1.0, 0.0, 0.0), dvec3(0.0, 1.0, 1.0), dmat3(1.0));
  CHECK_FALSE(coincident_patches(bricks.patches));
  const Surface second = box(dvec3(0.0), dvec3(1.0), dmat3(1.0));
  bricks.patches.insert(bricks.patches.end(), second.patches.begin(), second.patches.end());
  const auto pair = coincident_patches(bricks.patches);
  REQUIRE(pair);
  CHECK(pair->first < 6);
  CHECK(pair->second >= 6);
  bricks.patches.erase(bricks.patches.begin() + static_cast<std::ptrdiff_t>(pair->second));
  CHECK_FALSE(coincident_patches(bricks.patches));
  for (const char* family : {R"({"type": "sphere_tiling", "topology": "hemispheres"})",
                             R"({"type": "sphere_tiling", "topology": "rhombicuboctahedron"})",
                             R"({"type": "sphere_octant"})", R"({"type": "gc_octahedron"})"})
    CHECK_FALSE(coincident_patches(build_family(family).patches));
}

TEST_CASE("warnings name the object and its place", "[scene]") {
  const Scene scene = read_scene_text("s.json", R"({ "materials": { "glass": { "type": "dielectric" } },
"objects": [
  { "type": "sphere_tiling", "material": "glass" },
  { "type": "bezier", "name": "pane", "material": "glass", "patches": [
    { "kind": "tensor", "degree": [1, 1], "net": [[[0, 0, 0, 1], [0, 1, 0, 1]], [[1, 0, 0, 1], [1, 1, 0, 1]]] },
    { "kind": "tensor", "degree": [1, 1], "net": [[[0, 0, 0, 1], [1, 0, 0, 1]], [[0, 1, -0.0, 1], [1, 1, 0, 1]]] }
  ] } ] })",
                                      StagedScene::builtins());
  CHECK(
      scene_warnings(scene) ==
      std::vector<std::string>{
          "s.json:4:3: warning: pane: patches 0 and 1 lie on each other; of one object's walls in one place "
          "none comes first: bodies that share a wall want an object each",
          "s.json:4:3: warning: pane: a dielectric on a surface that is not closed; what lies behind it is "
          "inside and outside at once"});
}

}  // namespace
}  // namespace rondure
