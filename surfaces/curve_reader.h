// Rational curves in space and on the unit sphere as scenes write them.
#pragma once

#include "renderer/api/surface.h"
#include "renderer/bezier/rational_curve.h"

namespace rondure {

struct ReadCurve {
  std::vector<RationalCurve> pieces;  // each finite, in order, every one beginning where the last one ends
  std::vector<dvec4> polygon;         // control points of the whole; a weight may be zero
  std::vector<Note> notes;            // what there is to tell of the construction
};

// From exactly one of "net", "preimage", "interpolate", "spline", "arc" and "circle"; all but the first on
// the unit sphere, or on the quadric that is its image under a projective map.
ReadCurve read_curve(Params& params);

std::vector<ParameterDoc> curve_docs();

}  // namespace rondure
