// Where patches of a surface meet: sides that are the same curve in space.
#pragma once

#include <vector>

#include "renderer/api/surface.h"

namespace rondure {

// Side k of a patch runs from its corner k to the next, the patch on its left in the plane of (u, v). A
// triangle has corners (1, 0), (0, 1), (0, 0), a tensor patch (0, 0), (1, 0), (1, 1), (0, 1).
struct PatchSide {
  int patch = 0;
  int side = 0;
};
int side_count(const Net& net);
dvec2 side_point(const Net& net, int side, double t);

// Two sides that run through the same points of space. With `reversed` they do so in opposite directions, as
// they do where two patches have their normals on the same side.
struct Seam {
  PatchSide a, b;
  bool reversed = true;
};

// Corners of patches that are one point of space; where joins are given, corners that they glue.
struct SeamVertex {
  std::vector<PatchSide> corners;  // `side` is the corner
  bool closed = false;             // every side that ends there is in a seam or is no more than a point
};

struct Seams {
  std::vector<Seam> seams;
  std::vector<SeamVertex> vertices;
  std::vector<PatchSide> open;       // sides that meet no other
  std::vector<PatchSide> collapsed;  // sides that are a single point
  std::vector<bool> turned;          // of each patch: its normal is on the other side than the first one's
  bool orientable = true;            // `turned` fits all seams
  bool complete = true;              // not so many sides run between the same points that some went untried
};

// Sides match when both ends and 7 points between lie within 2^-30 of the surface's size from the other side;
// their parameters may differ. A side that is met by parts of several others counts as open. Given joins are
// taken as they are, so that a surface may pass through itself, and points of it that coincide stay apart.
Seams find_seams(const std::vector<Net>& patches, const std::vector<SideJoin>& joins);

}  // namespace rondure
