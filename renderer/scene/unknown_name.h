// The message for a name that nobody knows.
#pragma once

#include <string>
#include <vector>

namespace rondure {

// `unknown material "cly"; did you mean "clay"?`, or the list of known names when none is near.
std::string unknown_name(const std::string& noun, const std::string& name,
                         const std::vector<std::string>& known);

}  // namespace rondure
