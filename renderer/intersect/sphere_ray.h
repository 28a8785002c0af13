// One ray against a sphere of patches, its arithmetic spread over lanes.
//
// As in sphere_packets.h, whatever an ordinary ray needs is done here, with the bits of sphere_solver.h; of
// what needs more, nothing is told.
#pragma once

#include "renderer/intersect/sphere_solver.h"

namespace rondure {

// A sphere of patches (no other ellipsoid) in its place.
struct SphereTarget {
  const PatchedSphere* sphere;
  int surface;  // its index
  dvec3 frame;  // of the surface
  // The sphere's centre in the world: the exact sum of these. Their last components are zero.
  dvec4 center{0.0}, center_low{0.0};
  double radius2, inverse_radius;
  double stretch;  // error of a point, times the radius
};

SphereTarget target_at(const PatchedSphere& sphere, const dvec3& frame, int surface);

enum class RayAnswer { miss, hit, unknown };

// The closest hit; `hit` is set where there is one.
RayAnswer closest_on_sphere(const SphereTarget& target, const Ray& ray, Hit& hit) noexcept;
// Whether there is one at all.
RayAnswer sphere_occludes(const SphereTarget& target, const Ray& ray) noexcept;

// Squares of directions whose length needs no power of two to stay clear of the ends of doubles, and the most
// that their rays may be moved.
inline constexpr double shortest_direction2 = 0x1p-100, longest_direction2 = 0x1p100,
                        farthest_slide = 0x1p300;

}  // namespace rondure
