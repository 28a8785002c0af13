// Patches that lie on each other.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "renderer/api/patch.h"

namespace rondure {

// Two patches of one net, turned or mirrored: the walls of two bodies that share one, or a patch that is there
// twice. Of several such pairs the one that is complete first. (A sufficient test: nets may be one surface and
// differ by a factor.)
std::optional<std::pair<std::size_t, std::size_t>> coincident_patches(const std::vector<Net>& patches);

}  // namespace rondure
