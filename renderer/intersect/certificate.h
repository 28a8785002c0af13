// What is proven of a ray's closest hit, by interval arithmetic on the nets alone: no leaf, no hierarchy and
// no solver is trusted. The ray and the nets are the exact numbers that their doubles are.
#pragma once

#include <memory>

#include "renderer/intersect/tracer.h"

namespace rondure {

// How the proof was done. `boundary`: the root is proven on the polynomials, but not on which side of a side
// of its patch, so that rounding chose the owner among neighbours, and at the rim of an open surface the
// answer; the patch's point at the hit's (u, v) is proven to be within rounding of the ray, which is to say
// some 23 roundoffs of the patch's size, or 131 by `quadric`, and half an ulp of each parameter
// (certified_side.h).
enum class Means { interval, extended, boundary, unresolved };
const char* name_of(Means means);

struct Certificate {
  bool exists = false;  // the patch has a root within `t_error` of the hit's t
  bool unique = false;  // and no other root is as near to (u, v) as `isolation`
  bool first = false;   // no surface has a root at t in [t_min, t - t_error); of a miss, in [t_min, t_max]
  Means means = Means::unresolved;
  double t_error = 0.0;      // bounds |t - exact root|
  double point_error = 0.0;  // bounds the distance of the hit's point from the exact one
  double isolation = 0.0;    // in the patch's parameters; 0 for an analytic surface
  long pieces = 0;           // of patches looked at

  explicit operator bool() const { return means != Means::unresolved; }
};

class Certifier {
 public:
  // Refers to the surfaces of the tracer, which must live longer.
  explicit Certifier(const Tracer& tracer);
  ~Certifier();

  // `hit`: what tracer.closest(ray) said. The ray must start in free space (RayStart{}). Thread-safe.
  Certificate certify(const Ray& ray, const Hit& hit) const;

 private:
  struct Surfaces;
  std::unique_ptr<const Surfaces> surfaces_;
};

}  // namespace rondure
