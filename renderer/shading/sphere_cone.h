// The directions in which a sphere is seen from a point outside it: a cone, sampled uniformly by solid angle
// (Wang 1992, "Physically correct direct lighting for distribution ray tracing"). No sample falls on the far
// side, and the density is the same in all directions.
#pragma once

#include <optional>

#include "renderer/api/patch.h"

namespace rondure {

struct SphereCone {
  dvec3 axis{0.0};        // unit, toward the centre
  double distance = 0.0;  // of the centre
  double radius = 0.0;    // of the sphere
  double height = 0.0;    // 1 - cosine of the half angle

  double pdf() const;  // per solid angle, in every direction of the cone

  struct Sample {
    dvec3 direction{0.0};
    double distance = 0.0;  // of the sphere's near side
  };
  Sample sample(dvec2 uv) const;
};

// None for a radius of 0, and for a point inside the sphere or so close to it that the way to it is lost in
// rounding.
std::optional<SphereCone> sphere_cone(const dvec3& from, const dvec3& center, double radius);

}  // namespace rondure
