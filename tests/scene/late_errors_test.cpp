// Faults of a scene that come to light only when it is put to use still point at their cause in the file.
#include <filesystem>
#include <limits>

#include "renderer/film/exr.h"
#include "renderer/render/resume_key.h"
#include "tests/catch.h"
#include "tests/process.h"
#include "tests/render/staged_scene.h"
#include "tests/scene/messages.h"

namespace rondure {
namespace {

std::string late_complaint(const std::string& text, const SceneOverrides& overrides = {}) {
  return message_of([&] { StagedScene(text, overrides); });
}

// A patch of degree (1, 1) whose last weight is `weight`.
std::string patch(const std::string& weight) {
  return R"({ "kind": "tensor", "degree": [1, 1], "net": [ [ [0, 0, 0, 1], [0, 1, 0, 1] ], [ [1, 0, 0, 1], [1, 1, 0, )" +
         weight + "] ] ] }";
}

TEST_CASE("nets that no solver can bound are shown at their object", "[scene]") {
  const std::string endless =
      "a weight is not positive near (u, v) = (0.5, 1), or next to nothing beside the largest, however "
      "finely the patch is divided, so that it cannot be bounded";
  const std::string second =
      "  { \"type\": \"bezier\", \"patches\": [" + patch("1") + ", " + patch("-1") + "] }";
  const std::string message =
      late_complaint("{ \"objects\": [\n  { \"type\": \"sphere\" },\n" + second + "\n] }");
  CHECK(first_line(message) == "test.json:3:3: objects[1]: patch 1: " + endless);
  CHECK(message.ends_with("...\n    |   ^"));

  const std::string named =
      "{ \"objects\": [ { \"type\": \"bezier\", \"name\": \"sail\", \"patches\": [" + patch("-1") + "] } ] }";
  CHECK(first_line(late_complaint(named)) == "test.json:1:16: sail: patch 0: " + endless);

  // A projective transform sends the plane x = 2 to infinity, through the ball.
  CHECK(late_complaint("{ \"objects\": [\n"
                       "  { \"type\": \"sphere_tiling\", \"center\": [2, 0, 0],\n"
                       "    \"transform\": [[1,0,0,0], [0,1,0,0], [0,0,1,0], [1,0,0,-2]] } ] }")
            .starts_with("test.json:2:3: objects[0]: patch 0: a weight is not positive near (u, v) = ("));

  CHECK(late_complaint("{ \"objects\": [\n"
                       "  { \"type\": \"bezier\", \"patches\": [ { \"degree\": [1, 1],\n"
                       "    \"net\": [ [ [0,0,0,1], [1,0,0,1] ], [ [2,0,0,1], [3,0,0,1] ] ] } ] } ] }") ==
        "test.json:2:3: objects[0]: patch 0: has no area; its control points lie on a curve or in a point\n"
        "  2 |   { \"type\": \"bezier\", \"patches\": [ { \"degree\": [1, 1],\n"
        "    |   ^");
}

TEST_CASE("objects that are too large together are shown at their list", "[scene]") {
  CHECK(late_complaint("{\n  \"objects\": [ { \"type\": \"sphere\", \"radius\": 1e70 } ]\n}") ==
        "test.json:2:14: the scene is too large: its radius must be between 1e-60 and 1e+60\n"
        "  2 |   \"objects\": [ { \"type\": \"sphere\", \"radius\": 1e70 } ]\n"
        "    |              ^");
  CHECK(late_complaint(R"({ "objects": [ { "type": "sphere", "radius": 1e308 } ] })").find("is too large:") !=
        std::string::npos);
}

TEST_CASE("a fault set on the command line is named without a place", "[scene]") {
  const std::string ball = "{ \"objects\": [ { \"type\": \"sphere\" } ] }";
  SceneOverrides overrides;
  overrides.set = {
      "/objects/0={\"type\": \"bezier\", \"patches\": [{\"degree\": [1, 1], "
      "\"net\": [[[0,0,0,1],[1,0,0,1]],[[2,0,0,1],[3,0,0,1]]]}]}"};
  CHECK(
      late_complaint(ball, overrides) ==
      "test.json: objects[0]: patch 0: has no area; its control points lie on a curve or in a point (set on "
      "the command line)");
}

TEST_CASE("an image that is of no use is shown where the scene names it", "[scene]") {
  const std::string folder = fresh_folder("late_errors");
  const auto scene_with = [&](const std::string& file) {
    return "{ \"lights\": [\n  { \"type\": \"constant\" },\n  { \"type\": \"environment\", \"scale\": 2,\n   "
           " \"file\": \"" +
           file + "\" } ],\n  \"objects\": [ { \"type\": \"sphere\" } ] }";
  };
  const std::string text = folder + "/text.exr";
  write_text_file(text, "no picture at all");
  const std::string unread = late_complaint(scene_with(text));
  CHECK(unread.starts_with("test.json:4:13: " + text + ": cannot read the image: "));
  CHECK(unread.ends_with("    |             ^"));

  Film film(2, 1, {0, 0, 2, 1});
  film.samples = 1;
  FilmSample sample;
  sample.color = dvec3(0.0, 0.0, std::numeric_limits<double>::quiet_NaN());
  film.whole[1].add(sample);
  const std::string nan = folder + "/nan.exr";
  write_exr(nan, film, {0, 0, "path", "newton", default_camera()});
  CHECK(first_line(late_complaint(scene_with(nan))) ==
        "test.json:4:13: " + nan + ": the image holds a value that is no radiance: nan");
}

TEST_CASE("an image that is gone before a resumed render is shown too", "[scene]") {
  const std::string folder = fresh_folder("late_errors_key");
  const std::string file = folder + "/sky.hdr";
  write_text_file(file, "here now");
  const Scene scene = read_scene_text("test.json",
                                      "{ \"lights\": [ { \"type\": \"environment\", \"file\": \"" + file +
                                          "\" } ],\n  \"objects\": [ { \"type\": \"sphere\" } ] }",
                                      StagedScene::builtins());
  std::filesystem::remove(file);
  CHECK(first_line(message_of([&] { resume_key(scene, make_film(scene, {})); })) ==
        "test.json:1:48: " + file + ": cannot read the image");
}

}  // namespace
}  // namespace rondure
