// One step of Newton's method for two equations in two unknowns.
#pragma once

#include <glm/vec2.hpp>

#include "renderer/bezier/quotient.h"

namespace rondure {

// What to subtract from the unknowns: J^-1 f for the matrix J of columns (fu, fv), by Cramer's rule. Infinite
// or no number where J is singular, which no comparison with a bound passes.
inline glm::dvec2 newton_step(glm::dvec2 f, glm::dvec2 fu, glm::dvec2 fv) {
  const double det = fu.x * fv.y - fu.y * fv.x;
  return {quotient(fv.y * f.x - fv.x * f.y, det), quotient(fu.x * f.y - fu.y * f.x, det)};
}

}  // namespace rondure
