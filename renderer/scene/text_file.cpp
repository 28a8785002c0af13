#include "renderer/scene/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "renderer/api/utf8.h"

namespace rondure {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw SceneError(nullptr, {}, fmt::format("cannot read {}: {}", path, reason));
}

}  // namespace

std::string read_text_file(const std::string& path, std::size_t max_bytes) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) refuse(path, "it is a folder");
  // Pipes and devices tell no size, and are cut off below.
  const bool sized = std::filesystem::is_regular_file(path, error);
  const std::uintmax_t size = sized ? std::filesystem::file_size(path, error) : 0;
  const auto refuse_size = [&] { refuse(path, fmt::format("it is larger than {} bytes", max_bytes)); };
  if (!error && size > max_bytes) refuse_size();
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) refuse(path, std::generic_category().message(errno));
  std::string text;
  if (!error) text.reserve(static_cast<std::size_t>(size));
  char buffer[1 << 16];
  std::size_t count = 0;
  while ((count = std::fread(buffer, 1, sizeof buffer, file.get())) > 0) {
    if (text.size() + count > max_bytes) refuse_size();
    text.append(buffer, count);
  }
  if (std::ferror(file.get())) refuse(path, std::generic_category().message(errno));
  return text;
}

void refuse_bad_text(const SourceText& source) {
  SourcePosition where{1, 1};
  const std::string_view text = source.text;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    if (length == 0) {
      throw SceneError(&source, where,
                       fmt::format("byte 0x{:02X} is not UTF-8 text", static_cast<unsigned char>(text[i])));
    }
    where = text[i] == '\n' ? SourcePosition{where.line + 1, 1}
                            : SourcePosition{where.line, where.column + static_cast<int>(length)};
    i += length;
  }
}

}  // namespace rondure
