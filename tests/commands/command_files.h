// Small scenes and tables for tests of the command line.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/process.h"

namespace rondure {

inline constexpr const char* cube_scene =
    R"({ "objects": [ { "type": "sphere_tiling", "topology": "cube" } ] })";

// A fresh folder that holds scene.json.
inline std::string folder_with(const std::string& name, const std::string& scene = cube_scene) {
  const std::string folder = fresh_folder(name);
  write_text_file(folder + "/scene.json", scene);
  return folder;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The fields of a line of comma-separated text, empty ones included.
inline std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

// Rondure, run in a folder.
inline ProcessResult run_in(const std::string& folder, const std::vector<std::string>& arguments) {
  ProcessOptions options;
  options.folder = folder;
  return run_rondure(arguments, options);
}

inline double number_of(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

inline std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace rondure
