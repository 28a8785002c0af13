// The JSON Schema that ships with the scenes and the reader must accept and refuse the same documents.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "renderer/plugin/builtin.h"
#include "renderer/scene/scene_reader.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/process.h"
#include "tests/scene/messages.h"

namespace rondure {
namespace {

using Json = nlohmann::json;

Json parse(const std::string& text) { return Json::parse(text, nullptr, true, true); }

const Json& schema_document() {
  static const Json document = parse(read_text_file(source_folder() + "/scenes/schema/scene.schema.json"));
  return document;
}

bool schema_accepts(const Json& scene) {
  static const valijson::Schema* schema = [] {
    static valijson::Schema made;
    valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_document()), made);
    return &made;
  }();
  // Strong types: the reader does not take "1" for 1 either.
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  return validator.validate(*schema, valijson::adapters::NlohmannJsonAdapter(scene), nullptr);
}

std::string reader_says(const Json& scene) {
  static const Registry registry = [] {
    Registry made;
    register_builtins(made);
    return made;
  }();
  return first_line(
      message_of([&] { read_scene_text(source_folder() + "/scenes/s.json", scene.dump(), registry); }));
}

// Those at the top, or with their sub-folders; the schema is none.
std::vector<std::string> shipped_scenes(bool in_folders) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_folder() + "/scenes")) {
    const std::filesystem::path& path = entry.path();
    const std::string folder = path.parent_path().filename().string();
    if (path.extension() != ".json" || folder == "schema") continue;
    if (in_folders || folder == "scenes") paths.push_back(path.string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

// Every way to the nodes of a document.
void collect(const Json& node, const Json::json_pointer& at, std::vector<Json::json_pointer>& out) {
  out.push_back(at);
  if (node.is_object()) {
    for (const auto& [key, value] : node.items()) collect(value, at / key, out);
  } else if (node.is_array()) {
    for (std::size_t i = 0; i < node.size(); ++i) collect(node[i], at / i, out);
  }
}

class Agreement {
 public:
  void check(const Json& scene, const std::string& what) {
    const std::string said = reader_says(scene);
    ++count_;
    refused_ += said != "accepted";
    if ((said == "accepted") == schema_accepts(scene)) return;
    ++failures_;
    worst_ = fmt::format("{}: the reader says: {}", what, said);
  }
  long count_ = 0, refused_ = 0, failures_ = 0;
  std::string worst_;
};

TEST_CASE("every shipped scene passes the schema and is read", "[scene]") {
  const std::vector<std::string> paths = shipped_scenes(true);
  const std::string schema = source_folder() + "/scenes/schema/scene.schema.json";
  CHECK(paths.size() >= 7);
  for (const std::string& path : paths) {
    CAPTURE(path);
    const Json scene = parse(read_text_file(path));
    CHECK(schema_accepts(scene));
    CHECK(reader_says(scene) == "accepted");
    const std::filesystem::path beside = std::filesystem::path(path).parent_path();
    CHECK(std::filesystem::weakly_canonical(beside / scene.value("$schema", "")) ==
          std::filesystem::weakly_canonical(schema));
  }
}

TEST_CASE("schema and reader refuse the same damaged scenes", "[scene]") {
  Agreement swapped, added, removed;
  for (const std::string& path : shipped_scenes(false)) {
    const Json whole = parse(read_text_file(path));
    std::vector<Json::json_pointer> places;
    collect(whole, Json::json_pointer(), places);
    for (const Json::json_pointer& place : places) {
      const std::string name = std::filesystem::path(path).filename().string() + place.to_string();
      Json scene = whole;
      scene[place] =
          whole[place].is_boolean() ? Json("wrong") : Json(true);  // nowhere a value of the right kind
      swapped.check(scene, name + " swapped");
      if (whole[place].is_object()) {
        scene = whole;
        scene[place]["unheard_of"] = 1;
        added.check(scene, name + " with an unknown key");
      }
      // A material that is gone is missed by name, which no schema sees.
      if (place.empty() || place.parent_pointer().to_string() == "/materials" ||
          place.to_string() == "/materials")
        continue;
      scene = whole;
      if (scene[place.parent_pointer()].is_object()) {
        scene[place.parent_pointer()].erase(place.back());
      } else {
        scene[place.parent_pointer()].erase(static_cast<std::size_t>(std::stoul(place.back())));
      }
      removed.check(scene, name + " removed");
    }
  }
  INFO(swapped.worst_ << "\n" << added.worst_ << "\n" << removed.worst_);
  CHECK(swapped.failures_ == 0);
  CHECK(added.failures_ == 0);
  CHECK(removed.failures_ == 0);
  CHECK(swapped.refused_ == swapped.count_);
  CHECK(added.refused_ == added.count_);
  CHECK(swapped.count_ > 1000);
  CHECK(added.count_ > 100);
  CHECK(removed.refused_ > 100);
  CHECK(removed.refused_ < removed.count_);
}

TEST_CASE("schema and reader agree on every form and every limit", "[scene]") {
  struct Row {
    bool good;
    const char* place;  // of the value in a scene of one sphere
    const char* value;
  };
  const Row table[] = {
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
      {true, "/sampling", "{}"},
      {true, "/sampling", R"({"spp": 1, "seed": 0})"},
      {true, "/sampling", R"({"spp": 1073741824, "seed": 9007199254740992})"},
      {false, "/sampling", R"({"spp": 0})"},
      {false, "/sampling", R"({"spp": 1073741825})"},
      {false, "/sampling", R"({"seed": -1})"},
      {false, "/sampling", R"({"spp": 1.5})"},
      {true, "/integrator", "\"path\""},
      {true, "/integrator", "\"direct\""},
      {true, "/integrator", "\"normals\""},
      {false, "/integrator", "\"ao\""},
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
      {false, "/objects", "[]"},
      {false, "/objects", "{}"},
      {false, "/objects/0", "{}"},
      {true, "/objects/0/name", "\"\""},
      {true, "/objects/0/center", "[1, 2, 3]"},
      {false, "/objects/0/center", "[1, 2]"},
      {true, "/objects/0/radius", "1e-300"},
      {false, "/objects/0/radius", "0"},
      {false, "/objects/0/radius", "-1"},
      {false, "/objects/0/material", "1"},
      {true, "/objects/0/solver", "\"clipping\""},
      {false, "/objects/0/solver", "\"quadric\""},
      {true, "/objects/0/transform", "[]"},
      {false, "/objects/0/transform", "{}"},
      {false, "/objects/0/transform", "[1]"},
      {true, "/objects/0/transform", "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"},
      {false, "/objects/0/transform", "[[1,0,0,0],[0,1,0,0],[0,0,1,0]]"},
      {false, "/objects/0/transform", "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1]]"},
      {true, "/objects/0/transform",
       R"([{"translate": [1, 2, 3]}, {"rotate": {"axis": [1, 2, 3], "angle": 5}}])"},
      {true, "/objects/0/transform", R"([{"scale": -2}, {"scale": [1, 2, -3]}])"},
      {false, "/objects/0/transform", R"([{"scale": 0}])"},
      {false, "/objects/0/transform", R"([{"scale": [1, 0, 1]}])"},
      {false, "/objects/0/transform", R"([{"scale": 1, "translate": [1, 2, 3]}])"},
      {false, "/objects/0/transform", "[{}]"},
      {false, "/objects/0/transform", R"([{"rotate": {"axis": [1, 2, 3]}}])"},
      {false, "/objects/0/transform", R"([{"rotate": {"angle": 3}}])"},
      {false, "/objects/0/transform", R"([{"shear": 1}])"},
      {true, "/objects/0", R"({"type": "sphere_cap"})"},
      {true, "/objects/0", R"({"type": "sphere_cap", "z_max": 0.9})"},
      {false, "/objects/0", R"({"type": "sphere_cap", "z_max": 1})"},
      {false, "/objects/0", R"({"type": "sphere_cap", "z_max": -1})"},
      {true, "/objects/0", R"({"type": "sphere_cap", "middle_weight": 2})"},
      {false, "/objects/0", R"({"type": "sphere_cap", "middle_weight": 0})"},
      {true, "/objects/0", R"({"type": "sphere_tiling", "topology": "hemispheres", "middle_weight": 2})"},
      {false, "/objects/0", R"({"type": "sphere_tiling", "topology": "octants"})"},
      {false, "/objects/0", R"({"type": "sphere_tiling", "z_max": 0})"},
      {true, "/objects/0", R"({"type": "sphere_octant", "octants": [0, 7]})"},
      {false, "/objects/0", R"({"type": "sphere_octant", "octants": [0, 8]})"},
      {false, "/objects/0", R"({"type": "sphere_octant", "octants": [1, 1]})"},
      {false, "/objects/0", R"({"type": "sphere_octant", "octants": []})"},
      {false, "/objects/0", R"({"type": "bezier"})"},
      {false, "/objects/0", R"({"type": "bezier", "patches": []})"},
      {true, "/objects/0",
       R"({"type": "bezier", "closed": true, "patches": [{"kind": "tensor", "degree": [1, 1],
          "net": [[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[1,1,0,1]]]}]})"},
      {true, "/objects/0", R"({"type": "bezier", "patches": [{"degree": [1, 1],
          "net": [[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[1,1,0,1]]]}]})"},
      {false, "/objects/0", R"({"type": "bezier", "patches": [{"kind": "tensor", "degree": [0, 1],
          "net": [[[0,0,0,1],[0,1,0,1]]]}]})"},
      {false, "/objects/0", R"({"type": "bezier", "patches": [{"kind": "tensor", "degree": [1, 1],
          "net": [[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[1,1,0]]]}]})"},
      {true, "/objects/0", R"({"type": "bezier", "patches": [{"kind": "triangle", "degree": 1,
          "net": {"100": [1,0,0,1], "010": [0,1,0,1], "0,0,1": [0,0,0,1]}}]})"},
      {false, "/objects/0", R"({"type": "bezier", "patches": [{"degree": 1,
          "net": {"100": [1,0,0,1], "010": [0,1,0,1], "001": [0,0,0,1]}}]})"},
      {false, "/objects/0", R"({"type": "bezier", "patches": [{"kind": "triangle", "degree": 1,
          "net": {"100": [1,0,0,1], "010": [0,1,0,1], "1": [0,0,0,1]}}]})"},
      {false, "/objects/0", R"({"type": "bezier", "patches": [{"kind": "triangle", "degree": 1,
          "net": {"100": [1,0,0,1], "010": [0,1,0,1]}}]})"},
      {false, "/objects/0", R"({"type": "bezier", "file": ""})"},
  };
  for (const Row& row : table) {
    Json scene = parse(R"({ "objects": [ { "type": "sphere" } ] })");
    scene[Json::json_pointer(row.place)] = parse(row.value);
    CAPTURE(row.place, row.value);
    CHECK(schema_accepts(scene) == row.good);
    CHECK((reader_says(scene) == "accepted") == row.good);
  }
}

}  // namespace
}  // namespace rondure
