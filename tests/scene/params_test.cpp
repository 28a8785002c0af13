#include "renderer/api/params.h"

#include <cmath>

#include "renderer/scene/json_reader.h"
#include "tests/catch.h"
#include "tests/scene/messages.h"

namespace rondure {
namespace {

// The complaint of `read` about the object {"k": `value`}.
template <class Read>
std::string read_complaint(const std::string& value, Read read) {
  return first_line(message_of([&] {
    const Document document = read_json_text("s.json", "{\"k\": " + value + "}");
    Params params(document.root, document.source.get(), "thing");
    read(params);
  }));
}

TEST_CASE("values of the wrong type or range say what they must be", "[scene]") {
  const auto number = [](Range range) { return [range](Params& p) { p.number("k", range); }; };
  const auto integer = [](Params& p) { p.integer("k", 3, 1, 9); };
  const auto unbounded = [](Params& p) { p.integer("k", 0, std::numeric_limits<std::int64_t>::max()); };
  const auto text = [](Params& p) { p.text("k"); };
  const auto boolean = [](Params& p) { p.boolean("k", false); };
  const auto choice = [](Params& p) { p.choice("k", {"newton", "clipping"}, "newton"); };
  const auto vec2 = [](Params& p) { p.vec2("k", dvec2(0)); };
  const auto vec3 = [](Params& p) { p.vec3("k", Range::closed(0, 1)); };
  const auto color = [](Params& p) { p.color("k", dvec3(0)); };
  const auto numbers = [](Params& p) { p.numbers("k"); };
  const auto integers = [](Params& p) { p.integers("k", 0, 7); };
  const auto path = [](Params& p) { p.path("k"); };
  const auto object = [](Params& p) { p.object("k"); };
  const auto objects = [](Params& p) { p.objects("k"); };

  struct Row {
    const char* value;
    std::function<void(Params&)> read;
    const char* message;
  };
  const Row table[] = {
      {"\"big\"", number({}), "s.json:1:7: \"k\" must be a number, found \"big\""},
      {"\"big\"", number(Range::positive()),
       "s.json:1:7: \"k\" must be a number greater than 0, found \"big\""},
      {"0", number(Range::positive()), "s.json:1:7: \"k\" must be a number greater than 0, found 0"},
      {"-0.5", number(Range::not_negative()), "s.json:1:7: \"k\" must be a number of at least 0, found -0.5"},
      {"1", number(Range::open(-1, 1)), "s.json:1:7: \"k\" must be a number in (-1, 1), found 1"},
      {"1.5", number(Range::closed(0, 1)), "s.json:1:7: \"k\" must be a number in [0, 1], found 1.5"},
      {"1", number(Range{.high = 0, .open_high = true}),
       "s.json:1:7: \"k\" must be a number less than 0, found 1"},
      {"1", number(Range{.high = 0}), "s.json:1:7: \"k\" must be a number of at most 0, found 1"},
      {"null", number({}), "s.json:1:7: \"k\" must be a number, found null"},
      {"true", number({}), "s.json:1:7: \"k\" must be a number, found true"},
      {"{}", number({}), "s.json:1:7: \"k\" must be a number, found an object"},
      {"2.5", integer, "s.json:1:7: \"k\" must be an integer in [1, 9], found 2.5"},
      {"12.0", integer, "s.json:1:7: \"k\" must be an integer in [1, 9], found 12"},
      {"10", integer, "s.json:1:7: \"k\" must be an integer in [1, 9], found 10"},
      {"0", integer, "s.json:1:7: \"k\" must be an integer in [1, 9], found 0"},
      {"[]", integer, "s.json:1:7: \"k\" must be an integer in [1, 9], found an array of 0"},
      {"-1", unbounded, "s.json:1:7: \"k\" must be an integer of at least 0, found -1"},
      {"1", boolean, "s.json:1:7: \"k\" must be true or false, found 1"},
      {"1", text, "s.json:1:7: \"k\" must be a string, found 1"},
      {"\"netwon\"", choice,
       "s.json:1:7: \"k\" must be one of \"newton\", \"clipping\", found \"netwon\"; did you mean "
       "\"newton\"?"},
      {"\"fast\"", choice, "s.json:1:7: \"k\" must be one of \"newton\", \"clipping\", found \"fast\""},
      {"3", choice, "s.json:1:7: \"k\" must be one of \"newton\", \"clipping\", found 3"},
      {"[1]", vec2, "s.json:1:7: \"k\" must be an array of 2 numbers, found an array of 1"},
      {"3", vec3, "s.json:1:7: \"k\" must be an array of 3 numbers, found 3"},
      {"[1, 2]", vec3, "s.json:1:7: \"k\" must be an array of 3 numbers, found an array of 2"},
      {"[0, 1, 1.5]", vec3, "s.json:1:14: \"k\"[2] must be a number in [0, 1], found 1.5"},
      {"[0, \"x\", 1]", vec3, "s.json:1:11: \"k\"[1] must be a number in [0, 1], found \"x\""},
      {"-1", color, "s.json:1:7: \"k\" must be a number of at least 0, found -1"},
      {"\"red\"", color,
       "s.json:1:7: \"k\" must be a colour: a number or an array of 3 numbers, found \"red\""},
      {"[1, 1]", color,
       "s.json:1:7: \"k\" must be a colour: a number or an array of 3 numbers, found an array of 2"},
      {"[1, 1, -1]", color, "s.json:1:14: \"k\"[2] must be a number of at least 0, found -1"},
      {"1", numbers, "s.json:1:7: \"k\" must be an array of numbers, found 1"},
      {"[1, []]", numbers, "s.json:1:11: \"k\"[1] must be a number, found an array of 0"},
      {"[1, 8]", integers, "s.json:1:11: \"k\"[1] must be an integer in [0, 7], found 8"},
      {"\"\"", path, "s.json:1:7: \"k\" must be a path, found \"\""},
      {"1", path, "s.json:1:7: \"k\" must be a path, found 1"},
      {"[]", object, "s.json:1:7: \"k\" must be an object, { ... }, found an array of 0"},
      {"{}", objects, "s.json:1:7: \"k\" must be an array of objects, found an object"},
      {"[{}, 1]", objects, "s.json:1:12: thing.k[1] must be an object, { ... }, found 1"},
      {"1", [](Params& p) { p.finish(); }, "s.json:1:2: unknown key \"k\" in thing; it takes none"},
      {"1", [](Params& p) { p.number("other"); },
       "s.json:1:1: thing: \"other\" is missing; it must be a number"},
      {"1", [](Params& p) { p.vec3("other"); },
       "s.json:1:1: thing: \"other\" is missing; it must be an array of 3 numbers"},
      {"1", [](Params& p) { p.text("other"); },
       "s.json:1:1: thing: \"other\" is missing; it must be a string"},
      {"1", [](Params& p) { p.fail("why"); }, "s.json:1:1: thing: why"},
      {"1", [](Params& p) { p.fail("k", "why"); }, "s.json:1:7: why"},
      {"1", [](Params& p) { p.fail("absent", "why"); }, "s.json:1:1: why"},
  };
  for (const Row& row : table) {
    CAPTURE(row.value);
    CHECK(read_complaint(row.value, row.read) == row.message);
  }
}

TEST_CASE("values of the right type come through", "[scene]") {
  const Document document =
      read_json_text("dir/s.json", R"({ "a": 2.5, "b": 7, "c": true, "d": "x", "e": [1, 2, 3],
      "f": 0.5, "g": [1, 2], "h": [], "i": { "j": 1 }, "p": "image.exr", "q": "/image.exr" })");
  Params params(document.root, document.source.get(), "thing");
  CHECK(params.number("a") == 2.5);
  CHECK(params.number("absent", 4.0, {}) == 4.0);
  CHECK(params.integer("b", 0, 9) == 7);
  CHECK(params.integer("absent", 5, 0, 9) == 5);
  CHECK(params.boolean("c", false));
  CHECK(!params.boolean("absent", false));
  CHECK(params.text("d") == "x");
  CHECK(params.text("absent", "y") == "y");
  CHECK(params.choice("d", {"w", "x"}, "w") == "x");
  CHECK(params.choice("absent", {"w", "x"}, "w") == "w");
  CHECK(params.vec3("e") == dvec3(1, 2, 3));
  CHECK(params.vec3("absent", dvec3(4)) == dvec3(4));
  CHECK(params.vec2("g", dvec2(0)) == dvec2(1, 2));
  CHECK(params.color("f", dvec3(0)) == dvec3(0.5));
  CHECK(params.color("e", dvec3(0)) == dvec3(1, 2, 3));
  CHECK(params.numbers("g") == std::vector<double>{1, 2});
  CHECK(params.integers("e", 0, 9) == std::vector<std::int64_t>{1, 2, 3});
  CHECK(params.objects("h").empty());
  CHECK(params.object("i").what() == "thing.i");
  CHECK(params.path("p") == "dir/image.exr");
  CHECK(params.path("q") == "/image.exr");
  CHECK(params.raw("absent") == nullptr);
  CHECK(params.has("i"));
  CHECK(!params.has("absent"));
  params.finish();
}

TEST_CASE("unread keys name the nearest known key", "[scene]") {
  const auto unread = [](const std::string& key) {
    return first_line(message_of([&] {
      const Document document = read_json_text("s.json", "{ \"radius\": 1,\n  \"" + key + "\": 2 }");
      Params params(document.root, document.source.get(), "objects[3]");
      params.number("radius");
      params.number("z_max", 0.0, {});
      if (params.has("file")) params.text("patches");
      params.finish();
    }));
  };
  CHECK(unread("z_mx") == "s.json:2:3: unknown key \"z_mx\" in objects[3]; did you mean \"z_max\"?");
  CHECK(unread("Z_MAX") == "s.json:2:3: unknown key \"Z_MAX\" in objects[3]; did you mean \"z_max\"?");
  CHECK(unread("rad") == "s.json:2:3: unknown key \"rad\" in objects[3]; did you mean \"radius\"?");
  CHECK(unread("colour") ==
        "s.json:2:3: unknown key \"colour\" in objects[3]; known keys: \"file\", \"radius\", \"z_max\"");
  // A name that was only asked after has been left out on purpose.
  const std::string only_asked = message_of([&] {
    const Document document = read_json_text("s.json", "{ \"file\": 1 }");
    Params params(document.root, document.source.get(), "it");
    REQUIRE(params.has("file"));
    params.finish();
  });
  CHECK(first_line(only_asked) == "s.json:1:3: \"file\" has no meaning in it as it stands");
}

TEST_CASE("a copy of Params counts its reads for the original", "[scene]") {
  const Document document = read_json_text("s.json", "{ \"a\": 1 }");
  Params params(document.root, document.source.get(), "it");
  Params copy = params;
  copy.number("a");
  CHECK(message_of([&] { params.finish(); }) == "accepted");
}

TEST_CASE("the nearest name is near", "[scene]") {
  const std::vector<std::string> names = {"sphere", "sphere_cap", "sphere_tiling", "bezier", "uv"};
  CHECK(nearest_name("spher", names) == "sphere");
  CHECK(nearest_name("shpere", names) == "sphere");
  CHECK(nearest_name("Bezier", names) == "bezier");
  CHECK(nearest_name("sphere_tilling", names) == "sphere_tiling");
  CHECK(nearest_name("sphere_c", names) == "sphere_cap");
  CHECK(nearest_name("tiling", names) == "sphere_tiling");
  CHECK(nearest_name("vu", names) == "uv");
  CHECK(nearest_name("cone", names).empty());
  CHECK(nearest_name("x", names).empty());
  CHECK(nearest_name("", names).empty());
  CHECK(nearest_name("sphere", {}).empty());
}

}  // namespace
}  // namespace rondure
