// Files of one command must not overwrite one another.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

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

// Throws std::runtime_error that names the first two roles of one file.
inline void refuse_equal_paths(const std::vector<NamedPath>& paths) {
  for (std::size_t j = 1; j < paths.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      if (same_file(paths[i].path, paths[j].path)) {
        throw std::runtime_error(
            fmt::format("{}: is {} and {} at once", paths[j].path, paths[i].role, paths[j].role));
      }
    }
  }
}

}  // namespace rondure
