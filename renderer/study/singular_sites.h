// The singular points of a surface, found and told apart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/api/surface.h"
#include "renderer/continuity/regularity.h"
#include "renderer/normals/normal_germ.h"

namespace rondure {

struct SingularSite {
  int patch = 0;
  dvec2 at{0.0};
  dvec3 point{0.0};   // in the surface's own frame
  std::string place;  // "corner", "side" or "inside"
  // "collapsed side"; "corner of 180 degrees" or "corner of 0 degrees" (a cusp), whose sides have one tangent
  // line; "cross-cap" inside, or "parallel tangents"; "vanishing tangent" (one of them) or "vanishing
  // tangents".
  std::string kind;
  NormalGerm germ;
  std::optional<dvec3> limit;
  // A unit direction of the parameters that leads inside.
  dvec2 inward{0.0};
  // Of collapsed sides: exact, as all control points on them are one.
  SingularPoint::Proof proof = SingularPoint::Proof::exact;
  double within = 0.0;  // of the zero, in the parameters, where `proof` is unique
};

struct SiteSearch {
  std::vector<SingularSite> sites;
  // Patches proved to be regular but for what is listed, and patches on which the proof was given up; the
  // pieces that it took.
  int proved = 0, undecided = 0;
  long pieces = 0;
};

// Zeros of Su x Sv, patch by patch: the sides that the normal polynomial has as factors (its zero
// coefficients are exact), of which the middle and both ends are listed, and the points that the certified
// search of renderer/continuity/regularity.h finds on what is left.
SiteSearch singular_sites(const Surface& surface);

}  // namespace rondure
