// From the unit square to the distributions that rendering needs. All are continuous but for a null set, so
// that stratification survives.
#pragma once

#include "renderer/api/patch.h"

namespace rondure {

// Orthonormal, right-handed, third axis given.
struct Frame {
  dvec3 x, y, z;

  dvec3 to_world(const dvec3& local) const { return x * local.x + y * local.y + z * local.z; }
  dvec3 to_local(const dvec3& world) const;
};

// A frame from a unit normal and nothing else, so that no picture depends on how a surface is parametrised.
// (Duff et al. 2017, "Building an orthonormal basis, revisited".)
Frame frame_about(const dvec3& normal);

// Uniform on the unit disk (Shirley and Chiu 1997), density 1 / pi.
dvec2 sample_disk(dvec2 uv);
// Cosine-weighted on the hemisphere z >= 0, density z / pi (Malley's method).
dvec3 sample_cosine_hemisphere(dvec2 uv);
// Uniform on the unit sphere, density 1 / (4 pi). uv.x runs along z, uv.y around it.
dvec3 sample_sphere(dvec2 uv);

}  // namespace rondure
