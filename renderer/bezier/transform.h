// Control nets under projective maps.
#pragma once

#include "renderer/api/patch.h"

namespace rondure {

// Every control point multiplied by `matrix` (GLM's columns; a point is a column). Affine and projective maps
// are exact on the rational surface. Where the map mirrors (negative determinant) a parameter is reversed, u
// on a tensor net and u with v on a triangle, so that outward normals stay outward.
Net transformed(const Net& net, const dmat4& matrix);
// Whether the determinant is negative.
bool mirrors(const dmat4& matrix);

// The same surface with d/du x d/dv turned round.
Net reversed(const Net& net);
// Which side (api/surface.h) of the patch so turned round is a side of a patch with that many; it runs the
// other way.
constexpr int reversed_side(int sides, int side) { return (sides - side) % sides; }

}  // namespace rondure
