// What is documented of a type is what its reader takes, with the defaults that it says.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "renderer/plugin/builtin.h"
#include "renderer/scene/scene_docs.h"
#include "renderer/scene/scene_reader.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/process.h"
#include "tests/scene/messages.h"

namespace rondure {
namespace {

using Json = nlohmann::json;

const Registry& registry() {
  static const Registry made = [] {
    Registry r;
    register_builtins(r);
    return r;
  }();
  return made;
}

std::string reader_says(const Json& scene) {
  return first_line(message_of([&] { read_scene_text("s.json", scene.dump(), registry()); }));
}

// A scene with one thing of the type in it, and the place of that thing.
Json scene_with(const std::string& kind, const std::string& type, Json::json_pointer& place) {
  Json scene = Json::parse(R"({ "objects": [ { "type": "sphere" } ] })");
  static const std::map<std::string, std::string> places = {
      {"surface", "/objects/0"}, {"integrator", "/integrator"}, {"material", "/materials/m"},
      {"light", "/lights/0"},    {"layer", "/film/layers/0"},   {"camera", "/camera"},
      {"filter", "/film/filter"}};
  const auto found = places.find(kind);
  place = Json::json_pointer(found != places.end() ? found->second
                             : type == "object"    ? "/objects/0"
                             : type == "scene"     ? ""
                                                   : "/" + type);
  if (kind == "light") scene["lights"] = Json::array();
  if (kind == "layer") scene["film"]["layers"] = Json::array();
  if (found != places.end()) scene[place]["type"] = type;
  if (found == places.end() && !scene.contains(place)) scene[place] = Json::object();
  if (type == "bezier") {
    scene[place]["patches"] =
        Json::parse(R"([{ "degree": [1, 1], "net": [[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[1,1,0,1]]] }])");
  }
  if (type == "projected_net") {
    scene[place]["patches"] =
        Json::parse(R"([{ "degree": [1, 1], "net": [[[1,0,0,0],[1,0,1,0]],[[1,1,0,0],[1,1,1,0]]] }])");
  }
  if (type == "composed_patch") {
    scene[place]["of"] = Json::parse(R"({ "type": "sphere_cap" })");
    scene[place]["domain"] = Json::parse(R"({ "degree": [1, 1], "net": [[[0,0],[0,1]],[[1,0],[1,1]]] })");
  }
  if (type == "spherical_quad" || type == "circular_quad")
    scene[place]["corners"] = Json::parse("[[1, -1, -1], [1, 1, -1], [1, 1, 1], [1, -1, 1]]");
  if (type == "circular_triangle") scene[place]["corners"] = Json::parse("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
  if (type == "quadric_patch") scene[place]["surface"] = Json::parse(R"({ "type": "sphere_tiling" })");
  if (type == "curve") scene[place]["circle"] = Json::parse("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
  if (type == "spherical_bspline") {
    scene[place]["net"] = Json::parse(
        "[[[1,0,0,0],[1,0,1,0],[1,0,2,0]],[[1,1,0,0],[1,1,1,0],[1,1,2,0]],[[1,2,0,0],[1,2,1,0],[1,2,2,0]]]");
  }
  if (type == "point") scene[place]["position"] = Json::parse("[0, 0, 5]");
  if (type == "environment") {
    const std::string file = fresh_folder("docs") + "/image.exr";
    write_text_file(file, "");  // reading it waits until the scene is built
    scene[place]["file"] = file;
  }
  return scene;
}

TEST_CASE("a type takes what its documentation says and nothing else", "[scene]") {
  std::size_t defaults = 0, types = 0;
  for (const TypeGroup& group : all_types(registry())) {
    for (const TypeDoc& type : group.types) {
      CAPTURE(group.kind, type.name);
      Json::json_pointer place;
      const Json scene = scene_with(group.kind, type.name, place);
      CHECK(reader_says(scene) == "accepted");
      ++types;
      // The complaint about a key like no other lists all that were asked for.
      Json odd = scene;
      odd[place]["qqqqqqqqqqqqqqqqqqqqqqqqqqqq"] = 0;
      const std::string said = reader_says(odd);
      std::set<std::string> accepted;
      const std::size_t list = said.find("known keys: ");
      REQUIRE(list != std::string::npos);
      for (std::size_t at = said.find('"', list); at != std::string::npos; at = said.find('"', at + 1)) {
        const std::size_t end = said.find('"', at + 1);
        accepted.insert(said.substr(at + 1, end - at - 1));
        at = end;
      }
      std::set<std::string> documented;
      if (group.kind != "part of a scene") documented.insert("type");
      for (const ParameterDoc& parameter : type.parameters) documented.insert(parameter.name);
      if (group.kind == "surface") {
        for (const ParameterDoc& parameter : scene_docs().at(1).parameters) documented.insert(parameter.name);
      }
      CHECK(accepted == documented);
      // Defaults that are values may stand in a scene; the rest is prose.
      for (const ParameterDoc& parameter : type.parameters) {
        const Json value = Json::parse(parameter.default_value, nullptr, false);
        if (value.is_discarded() || (type.name == "bezier" && parameter.name == "file")) continue;
        CAPTURE(parameter.name);
        Json explicit_default = scene;
        explicit_default[place][parameter.name] = value;
        CHECK(reader_says(explicit_default) == "accepted");
        ++defaults;
      }
    }
  }
  CHECK(types >= 22);
  CHECK(defaults >= 30);
}

}  // namespace
}  // namespace rondure
