// The GGX microfacet distribution (Trowbridge and Reitz 1975; Walter et al. 2007), isotropic, in the frame
// whose third axis is the surface normal. Directions are unit.
#pragma once

#include "renderer/api/patch.h"

namespace rondure {

struct Ggx {
  double alpha;

  // Density of microfacet normals: the integral of density(h) h.z over the hemisphere is 1.
  double density(const dvec3& half) const;
  // Smith's masking of one direction, and masking and shadowing of two, height-correlated (Heitz 2014).
  double masking(const dvec3& direction) const;
  double masking_shadowing(const dvec3& out, const dvec3& in) const;
  // A microfacet normal as visible from `out` (out.z > 0), with density masking * max(0, out . h) density /
  // out.z. By spherical caps (Dupuy and Benyoub 2023).
  dvec3 sample_visible(const dvec3& out, dvec2 uv) const;

 private:
  double lambda(const dvec3& direction) const;
};

}  // namespace rondure
