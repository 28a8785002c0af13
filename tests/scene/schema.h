// The JSON Schema that ships with the scenes, beside the reader that it must agree with.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "renderer/api/registry.h"

namespace rondure {

bool schema_accepts(const nlohmann::json& scene);

// The first line of the reader's complaint, or "accepted". Files are looked for in scenes/.
std::string reader_says(const nlohmann::json& scene, const Registry& registry);

// A scene of one sphere with one value of it set.
struct SchemaRow {
  bool good;
  const char* place;  // JSON pointer
  const char* value;  // JSON
};

// Checks that schema and reader, the latter with this registry, both say of each row what it says itself.
void check_rows(const std::vector<SchemaRow>& rows, const Registry& registry);

}  // namespace rondure
