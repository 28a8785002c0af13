#include "renderer/study/folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "renderer/api/version.h"
#include "renderer/film/atomic_file.h"

namespace rondure {

StudyFolder::StudyFolder(std::string path) : path_(std::move(path)) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (error || !std::filesystem::is_directory(path_))
    throw std::runtime_error(fmt::format("{}: cannot make the folder: {}", path_,
                                         error ? error.message() : "a file is in its place"));
}

void StudyFolder::write(const std::string& name, const std::string& text) const {
  AtomicFile file(path(name));
  std::ofstream out(file.temporary(), std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot write: the disk is full or failed", path(name)));
  file.commit();
}

std::string StudyFolder::read(const std::string& name) const {
  std::ifstream in(path(name), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string StudyFolder::kept(const std::string& name, const std::string& key,
                              const std::function<std::string()>& make) const {
  const std::string whole = fmt::format("rondure {}\n{}\n", version, key);
  if (read(key_name(name)) == whole) {
    std::string text = read(name);
    if (!text.empty()) return text;
  }
  std::string text = make();
  write(name, text);
  write(key_name(name), whole);
  return text;
}

std::string base64(const std::string& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve(bytes.size() * 4 / 3 + 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    unsigned long word = 0;
    for (std::size_t j = 0; j < 3; ++j)
      word = word << 8 | (k + j < bytes.size() ? static_cast<unsigned char>(bytes[k + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      out += k + j > bytes.size() ? '=' : digits[word >> (18 - 6 * j) & 63u];
  }
  return out;
}

std::string html_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

}  // namespace rondure
