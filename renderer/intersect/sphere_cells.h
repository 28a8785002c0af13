// The grid of cells by which points of the sphere find their patch.
#pragma once

#include "renderer/intersect/sphere_patches.h"

namespace rondure {

// Sets cells and candidates, of patches and inverses that are known.
//
// A cell that no side of a patch comes near (sides are bounded by their control points) lies wholly inside a
// patch, or outside: the patch that holds one of its points owns it. All others get candidates: whose sides
// come near, and who holds one of its points. Nothing is missed: what has no side in a cell fills it, or is
// not there.
void fill_sphere_cells(const std::vector<Net>& nets, SpherePatches& out);

}  // namespace rondure
