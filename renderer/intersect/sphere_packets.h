// Closest hits of many rays with a sphere of patches that is all there is, a ray a lane, by the widest
// instruction set of the machine.
//
// Whatever an ordinary ray needs is done here; a lane that needs more (a point at a seam, a start on this
// surface, an ellipsoid that is no sphere, a ray that grazes or of extreme length) is handed back. One lane
// or eight, on every instruction set: the same bits, which are those of `sphere_solver.h`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "renderer/intersect/sphere_ray.h"

namespace rondure {

// Sets hits[k], and done[k] to 1; or leaves the hit alone and sets done[k] to 0. Any count. Parameters on a
// sphere without patches are left to `finish` (query.h).
void closest_on_sphere(const SphereTarget& target, const Ray* rays, std::size_t count, Hit* hits,
                       unsigned char* done) noexcept;

// The instruction sets that this machine has, best first; and the choice of one, or of the best again by an
// empty name. For tests: not to be called while queries run.
std::vector<std::string> instruction_sets();
void use_instruction_set(const std::string& name);

}  // namespace rondure
