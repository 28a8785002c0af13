#include "renderer/projective/frame.h"

#include <cmath>

namespace rondure {

StereographicFrame::StereographicFrame(const lvec3& direction) : centre(direction / glm::length(direction)) {
  // The axis least in line with the centre, so that the cross product loses nothing.
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(centre[k]) < std::abs(centre[axis])) axis = k;
  }
  lvec3 other(0);
  other[axis] = 1;
  const lvec3 across = glm::cross(other, centre);
  e1 = across / glm::length(across);
  e2 = glm::cross(centre, e1);
}

}  // namespace rondure
