// UTF-8, and how to show it in messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rondure {

// Length in bytes of the character (RFC 3629: no surrogates, no overlong forms) at the front of `text`; 0
// when there is none, and for NUL.
std::size_t utf8_length(std::string_view text);

// The same text with control characters and stray bytes as "?", cut to `limit` characters.
std::string printable(std::string_view text, std::size_t limit = 60);

}  // namespace rondure
