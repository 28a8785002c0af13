// The quadrilaterals into which polyhedra divide the unit sphere (Cobb 1988, section 7).
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "renderer/projective/extended.h"

namespace rondure {

// Sides are great circles, corners counter-clockwise seen from outside, all on the unit sphere; `centre` is
// where the tile is projected about, by symmetry.
struct Tile {
  std::array<lvec3, 4> corner;
  lvec3 centre;
};

// Triangles of a regular polyhedron joined in pairs along an edge; corners 0 and 2 are off that edge.
std::vector<Tile> tetrahedron_pairs();  // 2, corners of 120 and 240 degrees
std::vector<Tile> octahedron_pairs();   // 4, corners of 90 and 180 degrees
std::vector<Tile> icosahedron_pairs();  // 10, corners of 72 and 144 degrees

// Triangles divided in three: corner, middle of an edge, middle of the face, middle of the other edge.
std::vector<Tile> tetrahedron_quads();  // 12
std::vector<Tile> octahedron_quads();   // 24
std::vector<Tile> icosahedron_quads();  // 60

// Six squares about the axes, twelve between them, and the eight triangles divided in three: 42 tiles, whose
// triangles' edges have a corner in the middle that the squares lack. Or edge to edge: the twelve squares
// halved there, 54 tiles.
std::vector<Tile> rhombicuboctahedron_42();
std::vector<Tile> rhombicuboctahedron_54();

}  // namespace rondure
