// One ray against a sphere of patches, its arithmetic spread over lanes.
//
// As in sphere_packets.h, whatever an ordinary ray needs is done here, with the bits of sphere_solver.h; of
// what needs more, nothing is told.
#pragma once

#include "renderer/intersect/sphere_solver.h"

namespace rondure {

// A sphere of patches in its place.
struct SphereTarget {
  // The sphere's centre in the world: the exact sum of these.
  dvec3 center{0.0};
  double radius2 = 0.0;
  dvec3 center_low{0.0};
  double inverse_radius = 0.0;
  dvec3 frame{0.0};  // of the surface
  double radius = 0.0;
  double stretch = 0.0;  // error of a point, times the radius
  const PatchedSphere* sphere = nullptr;
  int surface = 0;  // its index
};

// Of a sphere, no other ellipsoid.
SphereTarget target_at(const PatchedSphere& sphere, const dvec3& frame, int surface);

enum class RayAnswer { miss, hit, unknown };

// The closest hit, if its t is not beyond `farthest`; `hit` is set where there is one, but for the parameters
// on a sphere without patches, which `finish` (query.h) sets.
RayAnswer closest_on_sphere(const SphereTarget& target, const Ray& ray, double farthest, Hit& hit) noexcept;
// Whether there is one at all.
RayAnswer sphere_occludes(const SphereTarget& target, const Ray& ray) noexcept;

// Squares of directions whose length needs no power of two to stay clear of the ends of doubles, and the most
// that their rays may be moved.
inline constexpr double shortest_direction2 = 0x1p-100, longest_direction2 = 0x1p100,
                        farthest_slide = 0x1p300;

}  // namespace rondure
