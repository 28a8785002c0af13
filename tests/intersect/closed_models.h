// Every kind of closed surface that Rondure builds of patches: what rays must meet exactly once a wall.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "renderer/intersect/tracer.h"

namespace rondure {

struct ClosedModel {
  std::string name;
  Surface surface;
  double radius = 1.0;        // about surface.origin, of a sphere that contains it
  bool sphere = false;        // it is that sphere
  bool singular = false;      // a corner of a patch has no tangent plane by its first derivatives
  double band = 0.0;          // how far from tangency either answer is right, in radii: `tangency_band`
  std::vector<dvec3> inside;  // points inside, in the world
};

// The tilings of the sphere, and the closed inverse spherical and geometrically continuous (GC1) surfaces of
// the scenes. Points inside are found with the oracle.
const std::vector<ClosedModel>& closed_models();

// The model scaled and moved.
ClosedModel placed(const ClosedModel& model, double scale, const dvec3& center);

// How far from touching the surface a ray may be and yet be answered either way, in scene units. A root
// counts when its residual is below 12 (the solvers' `residual_roundoffs`) roundoffs of |S| + |base| w, where
// neither sum is more than its bound over a leaf; divided by w that is a distance, and the planes are at right
// angles. The sums are taken at points of a grid, and a quarter more for what lies between them.
double tangency_band(const Surface& surface, double radius);

}  // namespace rondure
