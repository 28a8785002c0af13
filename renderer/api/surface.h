// What a patch family is: a name, its documented parameters, and a function from parameters to control nets.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/api/params.h"
#include "renderer/api/patch.h"

namespace rondure {

// A rational Bezier curve beside the patches that a scene may show as a wire.
struct Guide {
  std::vector<dvec4> curve;  // control points (w x, w y, w z, w)
  double end_balls = 1.0;    // radius of the balls at its ends, in radii of the wire
};

// What a construction has to tell of its result, beside the result: rondure info prints it.
struct Note {
  std::string name;  // one word, such as "condition"; no two of a surface are the same
  double value;
  std::string meaning;  // "of the interpolation: ..."
};

// Two sides that a construction glues. Side k of a patch runs from its corner k to the next, counting (1, 0),
// (0, 1), (0, 0) on a triangle and (0, 0), (1, 0), (1, 1), (0, 1) on a tensor patch.
struct SideJoin {
  int patch = 0, side = 0, other = 0, other_side = 0;
  bool reversed = true;  // they run in opposite directions
};

// One surface in its own frame. Families build about the origin at unit size; the scene applies radius,
// centre and transform. `origin` stays apart from the nets, so that a small surface far away loses no bits.
struct Surface {
  std::vector<Net> patches;
  dvec3 origin{0.0};               // world position of the frame's zero
  std::optional<dmat3> ellipsoid;  // set, and `patches` empty: the analytic image of the unit sphere under it
  bool closed = false;             // bounds a solid: every line meets it an even number of times
  // What "show" may name beside the parts that every surface has, or in place of them.
  std::map<std::string, std::vector<Guide>> guides;
  std::vector<Note> notes;
  // All joints of patches, where the construction knows; elsewhere sides meet that are one curve in space.
  std::vector<SideJoin> joins;
  std::vector<std::string> warnings;  // what is allowed and seldom meant: a line each for the user
};

// One documented parameter, for `rondure describe`. `type` is prose such as "number in (-1, 1)".
struct ParameterDoc {
  std::string name;
  std::string type;
  std::string default_value;  // as it would stand in a scene; empty when the parameter is required
  std::string meaning;
};

struct SurfaceFamily {
  std::string name;     // the scene's "type", and the stem of the file that implements it
  std::string summary;  // one line, with source (author, year, section)
  std::vector<ParameterDoc> parameters;
  std::function<Surface(Params&)> build;  // throws SceneError through Params
};

}  // namespace rondure
