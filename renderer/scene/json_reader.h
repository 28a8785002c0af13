// JSON text to a tree of Values that know their place in the file.
//
// The language is JSON (RFC 8259) with // and /* */ comments. Refused, with file, line and column: duplicate
// keys, anything after the document, text that is not UTF-8, numbers beyond the range of a double (so NaN and
// infinities cannot occur), nesting deeper than 256, files over 512 MiB, more than 2^25 values (4 GB as a
// tree, 6 while it grows).
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "renderer/api/params.h"

namespace rondure {

inline constexpr std::size_t max_json_bytes = std::size_t{1} << 29;
inline constexpr std::size_t max_json_values = std::size_t{1} << 25;
inline constexpr int max_json_depth = 256;

struct Document {
  std::shared_ptr<const SourceText> source;
  Value root;
};

Document read_json_file(const std::string& path);
// `name` stands for the path in messages.
Document read_json_text(std::string name, std::string text);

}  // namespace rondure
