// The patches of an `iss` object: where they come from, and the operations on them.
#pragma once

#include <variant>
#include <vector>

#include "renderer/api/params.h"
#include "renderer/inverse_spherical/iss.h"

namespace rondure {

// With a planar projection domain, or any other: then only its net is kept.
using IssPatch = std::variant<PlanarIss, TriangleNet>;

TriangleNet net_of(const IssPatch& patch);

// From "octants", "fan", or "vertices", "degree" and "patches" (by default one octant with c = 1).
std::vector<IssPatch> read_iss_patches(Params& params);

// The steps of "modify", in order.
void modify_iss_patches(Params& params, std::vector<IssPatch>& patches);

}  // namespace rondure
