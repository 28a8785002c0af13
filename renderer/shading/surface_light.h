// Points on an emissive surface, drawn so that the density per area is known exactly where a ray meets it.
#pragma once

#include <vector>

#include "renderer/api/surface.h"
#include "renderer/intersect/ray.h"

namespace rondure {

// Each patch's domain is cut into a grid of cells, one of which is drawn by its estimated area, then a
// parameter in it uniformly. The density per area divides by |du x dv| at the very point, so that a rough
// estimate of a cell's area costs noise, never bias. An analytic ellipsoid is sampled through its unit
// sphere; but an analytic sphere, from a point outside, by the solid angle in which it is seen.
class SurfaceLight {
 public:
  // The surface must outlive the light.
  explicit SurfaceLight(const Surface& surface);

  struct Sample {
    dvec3 point{0.0};
    dvec3 normal{0.0};     // unit, outward
    double density = 0.0;  // per area; 0 where the surface is singular
  };
  Sample sample(dvec2 uv) const;
  // Density per area with which `sample` draws the hit's point.
  double density(const Hit& hit) const;

  // A direction from a point to the light.
  struct Direction {
    dvec3 direction{0.0};   // unit
    double distance = 0.0;  // of the light that way
    double pdf = 0.0;       // per solid angle; 0 where the sample came to nothing, such as the far side
  };
  Direction sample_toward(const dvec3& from, dvec2 uv) const;
  // Density per solid angle with which `sample_toward` draws the way to the hit.
  double pdf_toward(const dvec3& from, const Hit& hit) const;
  double area() const { return area_; }

 private:
  const Surface* surface_;
  std::vector<double> cumulative_;  // running sums of the cells' shares, patch by patch; one more than cells
  double area_ = 0.0;
  double radius_ = 0.0;  // of an analytic sphere; 0 for all else
  dmat3 inverse_{1.0};   // of the ellipsoid's matrix
  dmat3 cofactor_{1.0};  // takes the unit sphere's area vectors to the ellipsoid's

  double cell_density(std::size_t cell, const dvec3& area_vector) const;
};

}  // namespace rondure
