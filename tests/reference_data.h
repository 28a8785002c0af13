// The tables of tests/data.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "renderer/api/patch.h"
#include "tests/paths.h"

namespace rondure {

// `file` is a name within tests/data.
inline nlohmann::json reference_data(const std::string& file) {
  std::ifstream stream(source_folder() + "/tests/data/" + file);
  return nlohmann::json::parse(stream);
}

// The entry of that "name"; null when there is none.
inline nlohmann::json reference_entry(const nlohmann::json& table, const std::string& name) {
  for (const nlohmann::json& entry : table) {
    if (entry["name"] == name) return entry;
  }
  return {};
}

// A JSON number, "3/8" or decimals.
inline double number(const nlohmann::json& value) {
  if (value.is_number()) return value.get<double>();
  const std::string text = value.get<std::string>();
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return std::stod(text);
  return std::stod(text.substr(0, slash)) / std::stod(text.substr(slash + 1));
}

inline dvec3 vector(const nlohmann::json& value) {
  return {number(value[0]), number(value[1]), number(value[2])};
}

}  // namespace rondure
