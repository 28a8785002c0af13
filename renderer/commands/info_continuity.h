// What `rondure info` tells of how patches meet, and of whether they are regular.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "renderer/api/surface.h"

namespace rondure {

// Adds "continuity" (where patches meet at all) and "regularity".
void add_continuity(nlohmann::ordered_json& object, const Surface& surface, bool certify);

// The lines of text for an object that has these.
std::string continuity_text(const nlohmann::ordered_json& object);

}  // namespace rondure
