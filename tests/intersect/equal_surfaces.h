// The same surface by other nets: subdivided, of higher degree, or projectively re-parametrised.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/api/surface.h"

namespace rondure {

// A patch of the new surface: which old patch it is of, and where its parameters are there.
struct PieceOf {
  int patch = 0;
  std::function<dvec2(dvec2)> back;
};

struct EqualSurface {
  std::string name;
  Surface surface;
  std::vector<PieceOf> pieces;
  // By how many roundoffs of itself a new control point is wrong: each is a combination of old ones with
  // factors that are not negative, so that sum B |P| of the new net, times this, bounds what is wrong of sum
  // B P.
  double roundings = 0.0;
};

// Halves along u, v (of triangles: the longest edge halved), quarters, elevated by one and by three degrees,
// weights times c^i by powers of two, which rounds nothing, and by other factors.
std::vector<EqualSurface> equals_of(const Surface& surface);

}  // namespace rondure
