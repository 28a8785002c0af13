// Files of one command must not overwrite one another, nor what the command reads.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "renderer/scene/scene.h"

namespace rondure {

struct NamedPath {
  std::string role;  // "the output"
  std::string path;
};

// Whether both name one file, that exists or would be made: also by links, "." and "..".
inline bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  const auto resolved = [&](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  const std::filesystem::path first = resolved(a), second = resolved(b);
  return !first.empty() && first == second;
}

// What a scene is made of: its own file and those that it refers to.
inline std::vector<NamedPath> input_paths(const Scene& scene) {
  std::vector<NamedPath> paths = {{"the scene", scene.path}};
  for (const std::string& file : scene.files) paths.push_back({"a file that the scene reads", file});
  return paths;
}

// Throws std::runtime_error that names the roles of a file that is an output and something else too.
inline void refuse_equal_paths(const std::vector<NamedPath>& inputs, const std::vector<NamedPath>& outputs) {
  const auto refuse_same = [](const NamedPath& a, const NamedPath& b) {
    if (same_file(a.path, b.path))
      throw std::runtime_error(fmt::format("{}: is {} and {} at once", b.path, a.role, b.role));
  };
  for (std::size_t j = 0; j < outputs.size(); ++j) {
    for (const NamedPath& input : inputs) refuse_same(input, outputs[j]);
    for (std::size_t i = 0; i < j; ++i) refuse_same(outputs[i], outputs[j]);
  }
}

// The same for a command from table to table; "-" is no file.
inline void refuse_table_over_input(const Scene& scene, const std::string& table, const std::string& output) {
  if (output == "-") return;
  std::vector<NamedPath> inputs = input_paths(scene);
  if (table != "-") inputs.push_back({"the input table", table});
  refuse_equal_paths(inputs, {{"the output", output}});
}

}  // namespace rondure
