// Vectors of more digits than a double has: surfaces are built in them and rounded once.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rondure {

using lvec3 = glm::vec<3, long double, glm::defaultp>;

}  // namespace rondure
