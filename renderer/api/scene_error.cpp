// The text of a SceneError: where, what, the line, and a caret.
#include <fmt/format.h>

#include <algorithm>

#include "renderer/api/params.h"
#include "renderer/api/utf8.h"

namespace rondure {
namespace {

constexpr std::size_t excerpt_bytes = 96;

std::string_view line_of(const std::string& text, int line) {
  std::size_t start = 0;
  for (int i = 1; i < line; ++i) {
    start = text.find('\n', start);
    if (start == std::string::npos) return {};
    ++start;
  }
  std::string_view rest = std::string_view(text).substr(start);
  rest = rest.substr(0, rest.find('\n'));
  if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
  return rest;
}

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

// The line, or the part of it around the column when it is long, and a caret below. One column a character:
// tabs become single spaces.
std::string excerpt(std::string_view line, SourcePosition where) {
  const std::size_t caret = std::min(static_cast<std::size_t>(where.column - 1), line.size());
  std::size_t first = 0, last = line.size();
  if (line.size() > excerpt_bytes) {
    first = caret > excerpt_bytes / 2 ? caret - excerpt_bytes / 2 : 0;
    last = std::min(line.size(), first + excerpt_bytes);
    while (first > 0 && continues(line[first])) --first;
    while (last < line.size() && continues(line[last])) ++last;
  }
  const auto show = [](std::string_view part) {
    std::string text(part);
    std::replace(text.begin(), text.end(), '\t', ' ');
    return printable(text, text.size());
  };
  const std::string before = (first > 0 ? "..." : "") + show(line.substr(first, caret - first));
  const std::string behind = show(line.substr(caret, last - caret)) + (last < line.size() ? "..." : "");
  const auto width =
      before.size() - static_cast<std::size_t>(std::count_if(before.begin(), before.end(), continues));
  const std::string number = std::to_string(where.line);
  return fmt::format("\n  {} | {}{}\n  {:{}} | {:{}}^", number, before, behind, "", number.size(), "", width);
}

std::string message(const SourceText* source, SourcePosition where, const std::string& text) {
  if (!source) return text;
  if (where.line < 1) return fmt::format("{}: {}", source->name, text);
  return fmt::format("{}:{}:{}: {}{}", source->name, where.line, where.column, text,
                     excerpt(line_of(source->text, where.line), where));
}

}  // namespace

SceneError::SceneError(const SourceText* source, SourcePosition where, const std::string& text)
    : std::runtime_error(message(source, where, text)), where_(where) {}

}  // namespace rondure
