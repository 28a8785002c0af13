// What the tracer says of a ray, judged by the oracle.
#pragma once

#include <string>
#include <vector>

#include "renderer/intersect/tracer.h"
#include "tests/oracle/oracle.h"

namespace rondure {

struct Verdict {
  bool right = true;
  bool in_band = false;  // some of it was rounding's choice: tangency, or the ray's start on a wall
  bool certified = true;
  std::string text;  // what is wrong
  std::string seen;  // every root and graze of the oracle's
};

// Each certain crossing of a closed surface must be told exactly once, with t within its claimed error, and
// nothing else. `band`: distance from tangency in scene units within which either answer is right. Crossings
// within `doubt` (in t) of the ray's t_min are not asked for.
Verdict judge(const Surface& surface, const Ray& ray, const std::vector<Hit>& hits, double radius,
              double band, double doubt);

// Whether the line glances off a patch's edge by so little that rounding of the nets, which moves a root by
// its size over the cosine, decides whether that counts, or goes by a vertex so near that it enters by one
// patch and leaves by another in one place: then the parity of the crossings is rounding's choice, although
// each of them is certain.
bool touches_edge(const Surface& surface, const Ray& ray);

}  // namespace rondure
