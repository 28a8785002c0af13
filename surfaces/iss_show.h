// What an `iss` object draws of its patches beside or instead of the surface.
#pragma once

#include "renderer/api/surface.h"
#include "surfaces/iss_patches.h"

namespace rondure {

// The things that "show" may name, beside "surface".
enum class IssPart {
  control_surface,     // the n^2 planar triangles of equations 16 and 17
  control_net,         // their edges as wires, and balls at the control points
  spherical_triangle,  // the sides of the domain on the unit sphere, as wires
  domain               // the sides of the planar projection domain, as wires; none where it is not planar
};

void add_iss_part(IssPart part, const IssPatch& patch, double wire, std::vector<Net>& out);

}  // namespace rondure
