// Surfaces that are one and the same but for their place, so that one set of leaves serves them all.
#pragma once

#include <vector>

#include "renderer/intersect/tracer.h"

namespace rondure {

// For each surface the first one, maybe itself, with the same nets bit for bit, or the same ellipsoid, and
// the same solver. They differ by their origin alone.
std::vector<unsigned> find_twins(const std::vector<TracedSurface>& surfaces);

}  // namespace rondure
