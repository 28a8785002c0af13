// Rays aimed at a place of a surface, met by several solvers.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "renderer/intersect/tracer.h"

namespace rondure {

// What the rays at one place came to.
struct RayTrial {
  int hits = 0;
  double off = 0.0;  // the largest distance of a hit from the place, in units of the surface's extent
  long steps = 0, undecided = 0, cells = 0;  // of Newton's method; leaves left to clipping; its cells
};

class RayTrials {
 public:
  static constexpr std::size_t solver_count = 3;
  static constexpr int rays = 2;  // at each place: along the normal, and at 60 degrees to it
  // The solver that a scene takes by default, and the two that meet any patch.
  static constexpr std::array<const char*, solver_count> names = {"default", "newton", "clipping"};

  explicit RayTrials(const TracedSurface& traced);

  // In the surface's own frame.
  std::array<RayTrial, solver_count> at(const dvec3& point, const dvec3& normal) const;

 private:
  dvec3 origin_;
  std::vector<Tracer> tracers_;
};

}  // namespace rondure
