// The JSON Schema that ships with the scenes and the reader must accept and refuse the same documents.
#include "tests/scene/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "renderer/scene/scene_reader.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/process.h"
#include "tests/render/staged_scene.h"
#include "tests/scene/messages.h"

namespace rondure {
namespace {

using Json = nlohmann::json;

Json parse(const std::string& text) { return Json::parse(text, nullptr, true, true); }

const Json& schema_document() {
  static const Json document = parse(read_text_file(source_folder() + "/scenes/schema/scene.schema.json"));
  return document;
}

}  // namespace

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

std::string reader_says(const Json& scene, const Registry& registry) {
  return first_line(
      message_of([&] { read_scene_text(source_folder() + "/scenes/s.json", scene.dump(), registry); }));
}

void check_rows(const std::vector<SchemaRow>& rows, const Registry& registry) {
  for (const SchemaRow& row : rows) {
    Json scene = parse(R"({ "objects": [ { "type": "sphere" } ] })");
    scene[Json::json_pointer(row.place)] = parse(row.value);
    CAPTURE(row.place, row.value);
    CHECK(schema_accepts(scene) == row.good);
    CHECK((reader_says(scene, registry) == "accepted") == row.good);
  }
}

namespace {

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
    const std::string said = reader_says(scene, StagedScene::builtins());
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
    CHECK(reader_says(scene, StagedScene::builtins()) == "accepted");
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

}  // namespace
}  // namespace rondure
