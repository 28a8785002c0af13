// Text from files, checked before anything parses it.
#pragma once

#include <cstddef>
#include <string>

#include "renderer/api/params.h"

namespace rondure {

// The whole file. Throws SceneError with path and reason when it is missing, a folder, unreadable or larger
// than `max_bytes`.
std::string read_text_file(const std::string& path, std::size_t max_bytes);

// Throws SceneError at the first byte that is no UTF-8 (RFC 3629: no surrogates, no overlong forms) or that
// is NUL.
void refuse_bad_text(const SourceText& source);

}  // namespace rondure
