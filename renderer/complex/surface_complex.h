// Geometrically continuous surface complexes: polygons, which of their edges are glued, and how derivatives
// pass from one polygon to the next (Vidunas 2005, Definition 5.1).
//
// Polygons are the triangle with corners (1, 0), (0, 1), (0, 0) and the square with corners (0, 0), (1, 0),
// (1, 1), (0, 1): the domains of patches in api/patch.h, anticlockwise. Others differ by an affine map, which
// changes neither the polynomials nor what is continuous. Edge e runs from corner e to the next one with the
// parameter s from 0 to 1. Its frame is `along`, from corner e to the next, and `inward`, from corner e to
// the one before; both are constant vectors.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "renderer/complex/edge_function.h"

namespace rondure {

struct EdgeRef {
  int polygon = 0;
  int edge = 0;
  friend bool operator==(const EdgeRef&, const EdgeRef&) = default;
};

// A linear map of tangent vectors for every s: column 0 is the image of `along` of the first edge, column 1
// that of `inward`, each as (along, inward) of the second edge. entry[row][column].
using BundleMap = std::array<std::array<EdgeFunction, 2>, 2>;

// Edge p is glued to q, point s to point parameter(s); `bundle` takes vectors over there (mu and theta of the
// definition). The maps the other way are the inverses.
struct EdgeJoin {
  EdgeRef p, q;
  EdgeFunction parameter;
  BundleMap bundle;
};

struct SurfaceComplex {
  std::vector<int> sides;  // of each polygon: 3 or 4
  std::vector<EdgeJoin> joins;
  bool exact = true;  // false: some numbers are rounded, so that what they cancel is small instead of 0
};

// A vector field along an edge, in its frame.
struct EdgeField {
  EdgeFunction along, inward;
};

// s or 1 - s.
EdgeFunction edge_parameter(bool reversed);

// The join for which the fields pass into each other's opposite, D_xi f = -D_eta g (Vidunas 2005, Definition
// 2.2): theta(xi(s)) = -eta(parameter(s)), and theta is the parameter's derivative along the edge.
EdgeJoin join_by_fields(EdgeRef p, EdgeRef q, const EdgeFunction& parameter, const EdgeField& xi,
                        const EdgeField& eta);

// The join whose theta takes `inward` to the given field along q (as a function of s), and is the parameter's
// derivative along the edge.
EdgeJoin join_by_image(EdgeRef p, EdgeRef q, const EdgeFunction& parameter, const EdgeField& image);

// A polygon's corner, and a way round a vertex through the corners that are glued to each other there.
struct Corner {
  int polygon = 0;
  int corner = 0;
  friend bool operator==(const Corner&, const Corner&) = default;
};

// A step from one corner of a fan to the next, across a join, forwards (from p to q) or backwards.
struct FanStep {
  int join = 0;
  bool forwards = true;
};

struct VertexFan {
  std::vector<Corner> corners;  // in order; steps[k] leads from corner k to the next
  std::vector<FanStep> steps;   // as many as corners when closed, one less otherwise
  bool closed = false;
};

// The joins of every edge: joined[polygon][edge] is the index of its join, or -1. Of several the last one.
std::vector<std::vector<int>> joins_by_edge(const SurfaceComplex& complex);

// All vertices. Every edge must be in one join at most, and parameters must take ends to ends.
std::vector<VertexFan> vertex_fans(const SurfaceComplex& complex);

// The fan's vertex as seen from a corner: index into vertex_fans for [polygon][corner].
std::vector<std::vector<int>> fan_of_corner(const SurfaceComplex& complex,
                                            const std::vector<VertexFan>& fans);

struct Topology {
  int vertices = 0, edges = 0, polygons = 0;
  int parts = 0;           // connected
  int boundary_edges = 0;  // 0 when the complex is closed
  bool orientable = false;
  std::vector<int> part;  // of each polygon: which part it belongs to
  // Of each polygon: to be turned round for all to agree with the first of its part.
  std::vector<bool> turned;
  int euler() const { return vertices - edges + polygons; }
};
Topology topology_of(const SurfaceComplex& complex);

// Corners and the vectors of an edge's frame in the polygon's plane.
std::array<int, 2> corner_point(int sides, int corner);
std::array<std::array<int, 2>, 2> edge_frame(int sides, int edge);  // {along, inward}

// "edge 2 of polygon 5".
std::string name_of(const EdgeRef& edge);

}  // namespace rondure
