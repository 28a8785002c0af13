// A family's surface from the text of its object in a scene.
#pragma once

#include <string>

#include "renderer/api/surface.h"

namespace rondure {

// `text` is the object, "type" included. Throws what the family throws, and for parameters that nobody read.
Surface build_family(const std::string& text);

// The message of the error that building throws, or "no error".
std::string family_error(const std::string& text);

// The first line of that message, after "file:line:column: ".
std::string complaint(const std::string& text);

}  // namespace rondure
