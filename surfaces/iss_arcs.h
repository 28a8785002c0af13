// Great-circle arcs over which an `iss` object is drawn.
#pragma once

#include "renderer/api/surface.h"
#include "surfaces/iss_patches.h"

namespace rondure {

// The curves of the surface over the arcs of "arcs", as tubes of radius `wire`. Nothing where there are none.
void add_iss_arcs(Params& params, const std::vector<IssPatch>& patches, double wire, std::vector<Net>& out);

}  // namespace rondure
