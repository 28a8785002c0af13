// Patches between four plane sections of a ruled quadric, as scenes write them.
#pragma once

#include <vector>

#include "renderer/api/surface.h"
#include "renderer/projective/preimage.h"

namespace rondure {

// From "corners", "sections", "construction" and "quartic". The quadric must be ruled.
Preimage read_section_quad(Params& params, const Quadric& quadric);

std::vector<ParameterDoc> section_quad_docs();

}  // namespace rondure
