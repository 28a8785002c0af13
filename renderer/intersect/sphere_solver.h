// Patches that lie on one ellipsoid, met as that: the ray's roots in closed form, then the patch that holds
// them.
#pragma once

#include <memory>
#include <optional>

#include "renderer/intersect/ellipsoid.h"
#include "renderer/intersect/sphere_patches.h"

namespace rondure {

// center + linear . (unit sphere), in the surface's frame, and what of it is there. Ellipsoids whose patches
// are the same but for a rotation of the unit sphere share what is known of them.
struct alignas(64) PatchedSphere {
  // First, and close together, what most rays need: scenes may have many.
  dvec3 center{0.0};
  double radius = 0.0, inverse_radius = 0.0;  // of a sphere; 0 of other ellipsoids
  double error = 0.0;    // bound on the distance of a hit from the patch's own, at right angles to the ray
  double outward = 0.0;  // what all patches have in common, as in SpherePatch; 0: nothing
  // What patch k is called in the surface: first + k, or names[k] where they do not follow one another.
  std::int32_t first = 0;
  bool turned = false, named = false;
  std::shared_ptr<const SpherePatches> patches;  // none where the whole surface is one
  dmat3 turn{1.0};  // from the unit sphere's space to that of the patches, where it is another
  std::vector<std::int32_t> names;
  Ellipsoid ellipsoid{dmat3(1.0)};

  dvec3 to_patches(const dvec3& n) const { return turned ? turn * n : n; }
  std::int32_t name_of(std::int32_t patch) const {
    return !named ? first + patch : names[static_cast<std::size_t>(patch)];
  }
};

// About the frame's zero, as a surface of its own.
PatchedSphere without_patches(const Ellipsoid& ellipsoid);

// Radii of spheres, beyond which they are met as other ellipsoids are.
inline constexpr double smallest_radius = 1e-100, largest_radius = 1e100;

// The net in the unit sphere's space.
Net image_of(const PatchedSphere& sphere, const Net& net);

// What the sphere's two roots have in common.
struct SphereRoots {
  dvec3 from, direction;   // of the ray, about the centre, in the unit sphere's space
  double middle, half;     // roots at middle -+ half, from the local ray's base
  double from_middle;      // the same from `from`: 0 where that is the middle
  double inverse_length2;  // of the ray's own direction; of an ellipsoid, of `direction`
};

// Of a line's point about a sphere's centre: how far from the middle of its chord, squared and in radii, it
// may be for the chord to be found from there. Rays come from 2^53 radii away before rounding takes them so
// far, and from 2^106 before it takes what is found about the middle so far again: those meet nothing.
inline constexpr double farthest_middle2 = 4.0;

// False when the ray misses the whole ellipsoid. `ray` is moved to where it passes the centre, the surface
// being at `frame`; its direction must be set.
bool meet_sphere(const PatchedSphere& sphere, const dvec3& origin, const dvec3& frame, LocalRay& ray,
                 SphereRoots& roots) noexcept;

// A point of the unit sphere.
struct SpherePoint {
  dvec3 n;
  dvec3 rough;  // the same, a few roundoffs beside it: its cell is known by this, before n is
};
// Side -1: where the ray enters, 1: where it leaves.
SpherePoint sphere_point(const SphereRoots& roots, int side) noexcept;

struct PlaceOnSphere {
  std::int32_t patch;
  double u, v;
  double outward;  // as in SpherePatch
};

// Where a point of the sphere may be instead, by rounding of the ray that met it.
struct Reach {
  dvec3 direction;  // of the ray, in the unit sphere's space
  double most;      // times the direction, either way
};

// The patch that holds a point of the unit sphere. A point beside all patches, but on one to within rounding
// (beside_roundoffs), is on that; of such patches on either side of a seam both would take it. Rounding moves
// a point along its ray by much more, where that grazes: a neighbour on a sphere of its own, or none, meets
// the ray that far on. Hence the point of a patch counts too that the ray passes that closely within reach.
std::optional<PlaceOnSphere> place_on_sphere(const PatchedSphere& sphere, const std::vector<Net>& nets,
                                             const SpherePoint& point, const Reach& reach) noexcept;
// Whether some patch holds it: without parameters, for the most part.
bool covers(const PatchedSphere& sphere, const std::vector<Net>& nets, const SpherePoint& point,
            const Reach& reach) noexcept;

// How far beside a patch a point still counts, relative to the semi-axes: 12 for the patch's own distance
// from the ellipsoid (ellipsoid_roundoffs), 4 for the point's, and for what a search leaves of a root beside
// singular points residual_roundoffs in either direction, in two coordinates.
inline constexpr double beside_roundoffs = 64.0;

}  // namespace rondure
