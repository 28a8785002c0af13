// Great-circle arcs over which an `iss` object is drawn.
#pragma once

#include "renderer/api/surface.h"
#include "surfaces/iss_patches.h"

namespace rondure {

// The curves of the surface over the arcs of "arcs". Nothing where there are none.
std::vector<Guide> read_iss_arcs(Params& params, const std::vector<IssPatch>& patches);

}  // namespace rondure
