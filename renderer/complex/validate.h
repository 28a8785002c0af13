// Whether a surface complex is one: conditions (1) to (5b) of Vidunas 2005, Definition 5.1.
//
// Two of them are taken as they must be meant, since the octahedron of the paper itself fails (5a) as
// printed: (5a) is asked of chains of corners whose ends are not glued to each other, (5b) of chains that
// close, p_n being glued to q_1. There the product of the maps is the identity, and the cones of the corners,
// laid side by side in one plane, go round exactly once.
#pragma once

#include <string>
#include <vector>

#include "renderer/complex/surface_complex.h"

namespace rondure {

struct Violation {
  std::string condition;  // "1" to "5b"
  std::string where;      // the edge or the vertex
  std::string what;       // what was found there
  double amount = 0.0;    // by how much
};

// Everything that is wrong, in the order of the conditions; what makes later ones meaningless ends the list.
// Where numbers are rounded (exact = false), equalities are asked to 1e-9.
std::vector<Violation> violations(const SurfaceComplex& complex);

// One line: "(4b) at edge 0 of polygon 1, glued to edge 2 of polygon 3: ...".
std::string text_of(const Violation& violation);

}  // namespace rondure
