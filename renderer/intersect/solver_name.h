// What finds a surface's hits, in words.
#pragma once

#include <string>

#include "renderer/intersect/tracer.h"

namespace rondure {

inline std::string solver_name(const TracedSurface& traced) {
  if (traced.surface.ellipsoid) return "closed form";
  return traced.solver == Solver::clipping  ? "clipping"
         : traced.solver == Solver::radial  ? "radial"
         : traced.solver == Solver::quadric ? "quadric"
                                            : "newton";
}

}  // namespace rondure
