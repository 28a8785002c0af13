// The JSON Schema and what `rondure describe` prints must name the same types and keys.
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "renderer/plugin/builtin.h"
#include "renderer/scene/scene_docs.h"
#include "tests/catch.h"
#include "tests/paths.h"
#include "tests/process.h"

namespace rondure {
namespace {

using Json = nlohmann::json;

const Json& schema() {
  static const Json document =
      Json::parse(read_text_file(source_folder() + "/scenes/schema/scene.schema.json"));
  return document;
}

// The schema's definition of a type: the one whose "type" is the name.
const Json* definition_of(const std::string& group, const std::string& name) {
  const Json& definition = schema().at("definitions").at(group);
  for (const char* form : {"oneOf", "anyOf"}) {
    if (!definition.contains(form)) continue;
    for (const Json& one : definition.at(form)) {
      if (one.contains("properties") && one["properties"].at("type").value("const", "") == name)
        return &one["properties"];
    }
  }
  return nullptr;
}

std::set<std::string> keys_of(const Json& properties) {
  std::set<std::string> keys;
  for (const auto& [key, value] : properties.items()) keys.insert(key);
  return keys;
}

TEST_CASE("schema and documentation know the same types and keys", "[scene]") {
  Registry registry;
  register_builtins(registry);
  const std::map<std::string, std::string> groups = {{"surface", "object"}, {"integrator", "integrator"},
                                                     {"layer", "layer"},    {"material", "material"},
                                                     {"light", "light"},    {"camera", "camera"}};
  std::map<std::string, TypeDoc> parts;
  for (const TypeGroup& group : all_types(registry)) {
    for (const TypeDoc& type : group.types) parts[type.name] = type;
  }
  std::size_t types = 0;
  for (const TypeGroup& group : all_types(registry)) {
    const auto definition = groups.find(group.kind);
    if (definition == groups.end()) continue;
    for (const TypeDoc& type : group.types) {
      CAPTURE(type.name);
      const Json* properties = definition_of(definition->second, type.name);
      REQUIRE(properties != nullptr);
      std::set<std::string> documented = {"type"};
      for (const ParameterDoc& parameter : type.parameters) documented.insert(parameter.name);
      if (group.kind == "surface") {
        for (const ParameterDoc& parameter : parts.at("object").parameters) documented.insert(parameter.name);
      }
      CHECK(keys_of(*properties) == documented);
      ++types;
    }
  }
  // Whatever these lists leave out passes for a plugin's.
  const auto listed = [](const char* definition) {
    return schema().at("definitions").at(definition).at("enum").get<std::set<std::string>>();
  };
  const std::vector<std::string> families = registry.family_names(),
                                 integrators = registry.integrator_names();
  CHECK(listed("object_type") == std::set<std::string>(families.begin(), families.end()));
  CHECK(listed("integrator_type") == std::set<std::string>(integrators.begin(), integrators.end()));
  const std::vector<std::string> layers = registry.layer_names();
  CHECK(listed("layer_type") == std::set<std::string>(layers.begin(), layers.end()));
  CHECK(types >= 5 + 3 + 4 + 4 + 2);
  for (const char* part : {"film", "sampling", "scene"}) {
    CAPTURE(part);
    const Json& definition = part == std::string("scene") ? schema() : schema().at("definitions").at(part);
    std::set<std::string> documented;
    for (const ParameterDoc& parameter : parts.at(part).parameters) documented.insert(parameter.name);
    CHECK(keys_of(definition.at("properties")) == documented);
  }
}

}  // namespace
}  // namespace rondure
