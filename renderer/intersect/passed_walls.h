// Walls that a path has met one after the other in one place.
#pragma once

#include <array>
#include <cstddef>

#include "renderer/intersect/ray.h"

namespace rondure {

// On an edge, and where solids share one, which of the walls comes first is no matter of rounding either:
// each ray that starts there finds walls at t = 0 again that the path has come through, some of them ahead,
// and a path might go round in them for ever. So it remembers on which side of each it is.
class PassedWalls {
 public:
  // That the path has come along `ray` to `hit`, from which it will go on. Where that is the place where it
  // started, to rounding, the wall that the ray left is one more; where it is another, all are forgotten.
  void arrive(const Ray& ray, const Hit& hit);

  // What they say of a wall of `surface` within rounding of the path's place: whether a ray in `direction`
  // meets it. Nothing for a wall that is not among them.
  enum class Answer { unknown, behind, ahead };
  Answer ask(int surface, const dvec3& normal, const dvec3& direction) const;

  bool empty() const { return count_ == 0; }

 private:
  struct Wall {
    int surface;
    dvec3 towards;  // the normal, on the side of it where the path is
  };

  void forget(int surface, const dvec3& normal);

  // All that eight boxes have at a vertex which they share; were there more, the oldest would give way.
  std::array<Wall, 24> walls_;
  std::size_t count_ = 0;
};

}  // namespace rondure
