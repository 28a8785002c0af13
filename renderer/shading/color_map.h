// Colours for numbers.
#pragma once

#include <string_view>

#include "renderer/api/patch.h"

namespace rondure {

// "viridis": dark blue to yellow, in even steps to the eye (Smith and van der Walt 2015); "diverging": blue,
// white, red; "grey": black to white.
// Linear RGB at t, clamped to [0, 1]; interpolated between the map's knots in the sRGB encoding. An unknown
// name is taken for "grey".
dvec3 mapped_color(std::string_view map, double t);

}  // namespace rondure
