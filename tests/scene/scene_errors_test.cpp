// What the reader says of scenes that are JSON but no scenes.
#include "renderer/plugin/builtin.h"
#include "renderer/scene/scene_reader.h"
#include "tests/catch.h"
#include "tests/scene/messages.h"

namespace rondure {
namespace {

std::string scene_complaint(const std::string& text) {
  Registry registry;
  register_builtins(registry);
  return message_of([&] { read_scene_text("s.json", text, registry); });
}

// The same for one object, on line 1 from column 15.
std::string object_complaint(const std::string& object) {
  return first_line(scene_complaint("{ \"objects\": [" + object + "] }"));
}

TEST_CASE("a complaint shows file, line, column, excerpt and remedy", "[scene]") {
  CHECK(scene_complaint("{\n  \"objects\": [\n\t{ \"type\": \"sphere\", \"radius\": \"big\" }\n  ]\n}") ==
        "s.json:3:32: \"radius\" must be a number greater than 0, found \"big\"\n"
        "  3 |  { \"type\": \"sphere\", \"radius\": \"big\" }\n"
        "    |                                ^");
}

TEST_CASE("scenes that lack or misname something say what and where", "[scene]") {
  const std::pair<const char*, const char*> table[] = {
      {"[]", "s.json:1:1: the scene must be an object, { ... }, found an array of 0"},
      {"{}", "s.json:1:1: the scene: \"objects\" is missing; it must be an array of objects"},
      {"{ \"objects\": [] }", "s.json:1:14: \"objects\" is empty; a scene needs at least one"},
      {"{ \"objects\": {} }", "s.json:1:14: \"objects\" must be an array of objects, found an object"},
      {"{ \"objects\": [1] }", "s.json:1:15: objects[0] must be an object, { ... }, found 1"},
      {"{ \"objects\": [{\"type\":\"sphere\"}], \"object\": [] }",
       "s.json:1:35: unknown key \"object\" in the scene; did you mean \"objects\"?"},
      {"{ \"objects\": [{\"type\":\"sphere\"}], \"fog\": 1 }",
       "s.json:1:35: unknown key \"fog\" in the scene; known keys: \"$schema\", \"camera\", \"comment\", "
       "\"film\", "
       "\"integrator\", \"lights\", \"materials\", \"name\", \"normals\", \"objects\", \"sampling\""},
      {"{ \"name\": 3 }", "s.json:1:11: \"name\" must be a string, found 3"},
      {"{ \"camera\": 3, \"objects\": [{\"type\":\"sphere\"}] }",
       "s.json:1:13: \"camera\" must be an object, { ... }, found 3"},
      {"{ \"camera\": {\"type\":\"fisheye\"}, \"objects\": [{\"type\":\"sphere\"}] }",
       "s.json:1:21: \"type\" must be one of \"perspective\", \"orthographic\", found \"fisheye\""},
      {"{ \"film\": {\"resolution\": [0, 480]} }",
       "s.json:1:27: \"resolution\"[0] must be an integer in [1, 65536], found 0"},
      {"{ \"film\": {\"filter\": \"gauss\"} }",
       "s.json:1:22: \"filter\" must be one of \"box\", \"tent\", \"gaussian\", \"blackman_harris\", found "
       "\"gauss\"; did "
       "you mean \"gaussian\"?"},
      {"{ \"film\": {\"layers\": [\"jacobean\"]} }",
       "s.json:1:23: unknown layer \"jacobean\"; did you mean \"jacobian\"?"},
      {"{ \"film\": {\"layers\": [\"jacobian\", {\"type\": \"jacobian\"}]} }",
       "s.json:1:35: layers[1]: the film has a channel \"Jacobian.sine\" already; name this one's group by "
       "\"as\""},
      {"{ \"film\": {\"layers\": [{\"type\": \"jacobian\", \"as\": \"a b\"}]} }",
       "s.json:1:50: \"as\" must be a name of letters, digits and underscores, which the layer's channels "
       "begin with"},
      {"{ \"sampling\": {\"spp\": 0} }",
       "s.json:1:23: \"spp\" must be an integer in [1, 1073741824], found 0"},
      {"{ \"sampling\": {\"spp\": 2.5} }",
       "s.json:1:23: \"spp\" must be an integer in [1, 1073741824], found 2.5"},
      {"{ \"sampling\": {\"seed\": -1} }",
       "s.json:1:24: \"seed\" must be an integer in [0, 9007199254740991], found -1"},
      {"{ \"sampling\": {\"sed\": 1} }",
       "s.json:1:16: unknown key \"sed\" in sampling; did you mean \"seed\"?"},
      {"{ \"sampling\": [] }", "s.json:1:15: \"sampling\" must be an object, { ... }, found an array of 0"},
      {"{ \"integrator\": \"paths\" }", "s.json:1:17: unknown integrator \"paths\"; did you mean \"path\"?"},
      {"{ \"integrator\": \"bdpt\" }",
       "s.json:1:17: unknown integrator \"bdpt\"; known: \"direct\", \"normals\", \"path\", \"study\""},
      {"{ \"integrator\": 1 }",
       "s.json:1:17: \"integrator\" must be a name or an object, { \"type\": name, ... }"},
      {"{ \"integrator\": {} }", "s.json:1:17: integrator: \"type\" is missing; it must be a string"},
      {"{ \"integrator\": {\"type\": \"path\", \"depth\": 3} }",
       "s.json:1:34: unknown key \"depth\" in integrator; did you mean \"max_depth\"?"},
      {"{ \"integrator\": {\"type\": \"path\", \"maxdepth\": 3} }",
       "s.json:1:34: unknown key \"maxdepth\" in integrator; did you mean \"max_depth\"?"},
      {"{ \"materials\": [] }", "s.json:1:16: \"materials\" must be an object, { name: material, ... }"},
      {"{ \"materials\": {\"clay\": 1} }", "s.json:1:25: materials.clay must be an object, { ... }, found 1"},
      {"{ \"materials\": {\"clay\": {\"type\": \"difuse\"}} }",
       "s.json:1:34: \"type\" must be one of \"diffuse\", \"mirror\", \"dielectric\", \"rough_conductor\", "
       "found "
       "\"difuse\"; did you mean \"diffuse\"?"},
      {"{ \"materials\": {\"clay\": {\"albedo\": 1.5}} }",
       "s.json:1:36: \"albedo\" must be a number in [0, 1], found 1.5"},
      {"{ \"materials\": {\"a\": {\"isolines\": {}}}, \"objects\": [{\"type\":\"sphere\", "
       "\"material\":\"a\"}] }",
       "s.json:1:82: \"sphere\" has no patches, and so no isolines; take a tiling, such as "
       "\"sphere_tiling\""},
      {"{ \"materials\": {\"a\": {\"curvature\": {}}}, \"objects\": [{\"type\":\"sphere\", "
       "\"material\":\"a\"}] }",
       "s.json:1:83: \"sphere\" has no patches, and so no colours of curvature; take a tiling, such as "
       "\"sphere_tiling\""},
      {"{ \"integrator\": {\"type\": \"study\", \"range\": [-1e308, 1e308]} }",
       "s.json:1:44: \"range\" is too wide for a double's exponent"},
      {"{ \"integrator\": {\"type\": \"study\", \"scale\": \"log\", \"range\": [1e-300, 1e300]} }",
       "s.json:1:60: \"range\" is too wide for a double's exponent"},
      {"{ \"materials\": {\"a\": {\"curvature\": {\"range\": [1, 1]}}} }",
       "s.json:1:46: \"range\" must be [low, high] with low < high, found [1, 1]"},
      {"{ \"objects\": [{\"type\":\"sphere\"}], \"lights\": [{\"type\":\"spot\"}] }",
       "s.json:1:54: \"type\" must be one of \"constant\", \"environment\", \"point\", \"directional\", "
       "found \"spot\""},
      {"{ \"objects\": [{\"type\":\"sphere\"}], \"lights\": [{\"type\":\"environment\", "
       "\"file\":\"no.exr\"}] }",
       "s.json:1:76: no such file: no.exr"},
  };
  for (const auto& [text, message] : table) {
    CAPTURE(text);
    CHECK(first_line(scene_complaint(text)) == message);
  }
}

TEST_CASE("a type unlike any other is told all types", "[scene]") {
  Registry registry;
  register_builtins(registry);
  std::string known;
  for (const std::string& name : registry.family_names())
    known += (known.empty() ? "\"" : ", \"") + name + "\"";
  CHECK(object_complaint("{\"type\": \"torus\"}") == "s.json:1:24: unknown type \"torus\"; known: " + known);
}

TEST_CASE("objects that lack or misname something say what and where", "[scene]") {
  const std::string matrix =
      "\"transform\" must be a 4x4 matrix (four rows of four numbers) or a list of steps";
  const std::pair<std::string, std::string> table[] = {
      {"{}", "s.json:1:15: objects[0]: \"type\" is missing; it must be a string"},
      {"{\"type\": \"sphre\"}", "s.json:1:24: unknown type \"sphre\"; did you mean \"sphere\"?"},
      {"{\"type\": \"sphere\", \"radius\": 0}",
       "s.json:1:44: \"radius\" must be a number greater than 0, found 0"},
      {"{\"type\": \"sphere\", \"radius\": \"\xC2\x9B\x31\"}",  // a terminal would obey U+009B
       "s.json:1:44: \"radius\" must be a number greater than 0, found \"?1\""},
      {"{\"type\": \"sphere\", \"center\": 0}",
       "s.json:1:44: \"center\" must be an array of 3 numbers, found 0"},
      {"{\"type\": \"sphere\", \"centre\": [0,0,0]}",
       "s.json:1:34: unknown key \"centre\" in objects[0]; did you mean \"center\"?"},
      {"{\"type\": \"sphere\", \"z_max\": 0.5}",
       "s.json:1:34: unknown key \"z_max\" in objects[0]; known keys: \"center\", \"isolines\", "
       "\"material\", \"name\", \"normals\", "
       "\"radius\", "
       "\"show\", \"solver\", \"transform\", \"type\", \"wire\", \"wire_material\""},
      {"{\"type\": \"sphere\", \"material\": \"clay\"}",
       "s.json:1:46: unknown material \"clay\"; there are none"},
      {"{\"type\": \"sphere\", \"normals\": \"crossfloat\"}",
       "s.json:1:45: \"normals\" must be one of \"limit\", \"cross\", \"cross_float\", \"taylor\", "
       "\"shift\", "
       "\"hodograph\", \"analytic\", found \"crossfloat\"; did you mean \"cross_float\"?"},
      {"{\"type\": \"sphere\", \"solver\": \"exact\"}",
       "s.json:1:44: \"solver\" must be one of \"auto\", \"newton\", \"clipping\", \"radial\", \"quadric\", "
       "found \"exact\""},
      {"{\"type\": \"sphere_cap\", \"z_max\": 1}",
       "s.json:1:47: \"z_max\" must be a number in (-1, 0.999999999], found 1"},
      {"{\"type\": \"sphere_tiling\", \"topology\": \"cubes\"}",
       "s.json:1:53: \"topology\" must be one of \"hemispheres\", \"cube\", \"cube_2_4\", "
       "\"icosahedron_pairs\", \"octahedron_pairs\", \"tetrahedron_quads\", \"octahedron_quads\", "
       "\"icosahedron_quads\", "
       "\"rhombicuboctahedron\", found \"cubes\"; did you mean \"cube\"?"},
      {"{\"type\": \"sphere\", \"transform\": 1}", "s.json:1:47: " + matrix},
      {"{\"type\": \"sphere\", \"transform\": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]}", "s.json:1:47: " + matrix},
      {"{\"type\": \"sphere\", \"transform\": [[1,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}",
       "s.json:1:48: " + matrix},
      {"{\"type\": \"sphere\", \"transform\": [[1,0,0,\"x\"],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}",
       "s.json:1:55: " + matrix},
      {"{\"type\": \"sphere\", \"transform\": [[1,0,0,0],[0,1,0,0],[0,1,0,0],[0,0,0,1]]}",
       "s.json:1:47: \"transform\" is singular: it flattens the surface"},
      {"{\"type\": \"sphere\", \"transform\": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,0]]}",
       "s.json:1:47: \"transform\" is singular: it flattens the surface"},
      {"{\"type\": \"sphere\", \"transform\": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0.1,0,0,1]]}",
       "s.json:1:47: \"sphere\": a projective transform does not keep an analytic sphere analytic; take a "
       "family of "
       "patches, such as \"sphere_tiling\""},
      {"{\"type\": \"sphere\", \"transform\": [{\"scale\": [1,1,1e-9]}]}",
       "s.json:1:47: \"sphere\": the closed form bears semi-axes in a ratio up to 1e+08; take a family of "
       "patches, such as \"sphere_tiling\""},
      {"{\"type\": \"sphere\", \"transform\": [{\"scale\": 1e200}, {\"scale\": 1e200}]}",
       "s.json:1:47: \"sphere\": its radius and transform multiply to a size that no number has"},
      {"{\"type\": \"sphere\", \"radius\": 1e-320}",
       "s.json:1:44: \"sphere\": its radius and transform multiply to a size that no number has"},
      {"{\"type\": \"sphere\", \"transform\": [{\"scale\": [1,0,1]}]}",
       "s.json:1:58: \"scale\" must not be zero: it flattens the surface"},
      {"{\"type\": \"sphere\", \"transform\": [{\"scale\": \"big\"}]}",
       "s.json:1:58: \"scale\" must be an array of 3 numbers, found \"big\""},
      {"{\"type\": \"sphere\", \"transform\": [{\"rotate\": {\"axis\": [0,0,0], \"angle\": 3}}]}",
       "s.json:1:68: \"axis\" must not be zero"},
      {"{\"type\": \"sphere\", \"transform\": [{\"rotate\": {\"axis\": [0,0,1]}}]}",
       "s.json:1:59: objects[0].transform[0].rotate: \"angle\" is missing; it must be a number"},
      {"{\"type\": \"sphere\", \"transform\": [{\"rotate\": 90}]}",
       "s.json:1:59: \"rotate\" must be an object, { ... }, found 90"},
      {"{\"type\": \"sphere\", \"transform\": [{\"translate\": [1]}]}",
       "s.json:1:62: \"translate\" must be an array of 3 numbers, found an array of 1"},
      {"{\"type\": \"sphere\", \"transform\": [{\"move\": [1,2,3]}]}",
       "s.json:1:49: unknown key \"move\" in objects[0].transform[0]; known keys: \"rotate\", \"scale\", "
       "\"translate\""},
      {"{\"type\": \"sphere\", \"transform\": [{}]}",
       "s.json:1:48: objects[0].transform[0]: a step takes one of \"translate\", \"rotate\" and \"scale\""},
      {"{\"type\": \"sphere\", \"transform\": [{\"scale\": 2, \"translate\": [1,2,3]}]}",
       "s.json:1:48: objects[0].transform[0]: a step takes one of \"translate\", \"rotate\" and \"scale\""},
      {"{\"type\": \"sphere\", \"transform\": [{\"scale\": 2}, 7]}",
       "s.json:1:62: objects[0].transform[1] must be an object, { ... }, found 7"},
  };
  for (const auto& [object, message] : table) {
    CAPTURE(object);
    CHECK(object_complaint(object) == message);
  }
}

TEST_CASE("an unknown material names the nearest one", "[scene]") {
  CHECK(
      first_line(scene_complaint("{ \"materials\": { \"clay\": {}, \"glass\": {\"type\": \"dielectric\"} },\n"
                                 "  \"objects\": [{\"type\": \"sphere\", \"material\": \"clya\"}] }")) ==
      "s.json:2:46: unknown material \"clya\"; did you mean \"clay\"?");
}

}  // namespace
}  // namespace rondure
