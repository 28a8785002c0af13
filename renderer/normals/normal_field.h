// The normals of one surface by any estimator, and what that needs to be known of its patches.
#pragma once

#include <memory>
#include <optional>

#include "renderer/api/surface.h"
#include "renderer/intersect/ray.h"
#include "renderer/normals/estimator.h"
#include "renderer/normals/implicit_quadric.h"

namespace rondure {

// The quadric on which a patch lies; `sign` turns its gradient into the direction of Su x Sv.
struct PatchQuadric {
  ImplicitQuadric quadric;
  double sign = 1.0;
};

// What a patch's estimators need is worked out when it is first asked for, once, from whatever thread.
class NormalField {
 public:
  // The surface must outlive the field.
  explicit NormalField(const Surface& surface);
  ~NormalField();
  NormalField(NormalField&&) noexcept;
  NormalField& operator=(NormalField&&) noexcept;

  // At parameters of a patch; there must be patches.
  NormalEstimate at(NormalEstimator estimator, int patch, double u, double v) const;
  // At a hit on this surface. An analytic surface has its own normal, whatever the estimator.
  NormalEstimate at(NormalEstimator estimator, const Hit& hit) const;

  // Null where the patch is on none, or its surface is an analytic one.
  const PatchQuadric* quadric(int patch) const;

 private:
  struct Known;

  const Surface* surface_;
  std::unique_ptr<Known> known_;
};

}  // namespace rondure
