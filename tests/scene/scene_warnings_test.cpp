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
  // Other patches of the same points.
  TensorNet saddle(1, 1);
  saddle.points = {dvec4(0, 0, 0, 1), dvec4(1, 0, 0, 1), dvec4(0, 1, 0, 1), dvec4(0, 0, 1, 1)};
  TensorNet other = saddle;
  std::swap(other.points[2], other.points[3]);
  CHECK_FALSE(coincident_patches({saddle, other}));
  TriangleNet triangle(2);
  for (int i = 0, k = 0; i <= 2; ++i)
    for (int j = 0; i + j <= 2; ++j, ++k) triangle.at(i, j) = dvec4(k, k * k, 0, 1);
  TriangleNet turned(2), mirrored(2), mixed = triangle;
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; i + j <= 2; ++j) {
      turned.at(i, j) = triangle.at(j, 2 - i - j);
      mirrored.at(i, j) = triangle.at(j, i);
    }
  std::swap(mixed.points[0], mixed.points[1]);
  CHECK(coincident_patches({triangle, turned}));
  CHECK(coincident_patches({triangle, mirrored}));
  CHECK_FALSE(coincident_patches({triangle, mixed}));
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
