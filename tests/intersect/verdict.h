// What the tracer says of a ray, judged by the oracle.
#pragma once

#include <string>
#include <vector>

#include "renderer/intersect/tracer.h"
#include "tests/intersect/closed_models.h"
#include "tests/oracle/oracle.h"

namespace rondure {

struct Verdict {
  bool right = true;
  bool in_band = false;  // some of it was rounding's choice: tangency, or the ray's start on a wall
  bool certified = true;
  std::string text;  // what is wrong
  std::string seen;  // every root and graze of the oracle's
};

// What the analytic sphere says of a ray's hits with a model that is one.
struct SphereVerdict {
  bool in_band = false;  // the line is as near to touching as leaves the count to rounding
  bool counted = true;   // there are as many hits as the sphere has
  bool many = false;     // there are more than any line has
  bool placed = true;    // and, outside of the band, each at its t
};
// A root lies where the surface is within the band of the ray, and so moves along the ray by no more than
// twice the band over the cosine of incidence; beyond that t may err by what the hit claims.
SphereVerdict judge_by_sphere(const ClosedModel& model, const Ray& ray, const std::vector<Hit>& hits);

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
