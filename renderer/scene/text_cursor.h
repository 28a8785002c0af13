// A place in a JSON text that moves forward from token to token and counts lines.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "renderer/api/params.h"

namespace rondure {

// A token begins at the first byte after the previous one that is not white space, comment, comma or colon:
// enough in a text whose grammar somebody else checks.
class TextCursor {
 public:
  explicit TextCursor(const std::string& text) : text_(text) {
    if (text.starts_with("\xEF\xBB\xBF")) offset_ = 3;  // a byte order mark
  }

  std::size_t offset() const { return offset_; }
  bool at_end() const { return offset_ >= text_.size(); }
  SourcePosition where() const { return {line_, static_cast<int>(offset_ - line_start_) + 1}; }

  void advance_to(std::size_t offset) {
    for (offset = std::min(offset, text_.size()); offset_ < offset; ++offset_) {
      if (text_[offset_] != '\n') continue;
      ++line_;
      line_start_ = offset_ + 1;
    }
  }

  // To the next token, but not beyond `limit`. False at a comment that is never closed.
  bool skip_to_token(std::size_t limit = std::string::npos) {
    while (offset_ < std::min(limit, text_.size())) {
      if (std::string_view(" \t\r\n,:").find(text_[offset_]) != std::string_view::npos) {
        advance_to(offset_ + 1);
      } else if (text_.compare(offset_, 2, "//") == 0) {
        advance_to(text_.find('\n', offset_));
      } else if (text_.compare(offset_, 2, "/*") == 0) {
        const std::size_t end = text_.find("*/", offset_ + 2);
        if (end == std::string::npos) return false;
        advance_to(end + 2);
      } else {
        return true;
      }
    }
    return true;
  }

  void pass_string() {
    std::size_t end = offset_ + 1;
    while (end < text_.size() && text_[end] != '"') end += text_[end] == '\\' ? 2 : 1;
    advance_to(end + 1);
  }
  void pass_word() {
    std::size_t end = offset_;
    while (end < text_.size() && is_word(text_[end])) ++end;
    advance_to(end);
  }
  void pass_bracket() { advance_to(offset_ + 1); }

  static bool is_word(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           c == '+' || c == '-' || c == '.';
  }

 private:
  const std::string& text_;
  std::size_t offset_ = 0;
  std::size_t line_start_ = 0;
  int line_ = 1;
};

}  // namespace rondure
