// Reflectance of smooth interfaces for unpolarised light (Born and Wolf, Principles of Optics, sections 1.5
// and 14.2).
#pragma once

#include "renderer/api/patch.h"

namespace rondure {

// `cosine` in [0, 1] on the side of the light, `eta` the index on the far side over that on the near side. 1
// beyond the critical angle.
double fresnel_dielectric(double cosine, double eta);

// Into a metal of index eta + i k, relative to the near side, channel by channel.
dvec3 fresnel_conductor(double cosine, const dvec3& eta, const dvec3& k);

}  // namespace rondure
