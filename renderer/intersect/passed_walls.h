// Walls that a path has met one after the other in one place.
#pragma once

#include <array>
#include <cstddef>

#include "renderer/intersect/ray.h"

namespace rondure {

// Where walls cross, on an edge or where solids share one, rounding alone says which of them a ray meets
// next, and from each it may say that another is still to come: a path would go round in them for ever. So it
// remembers on which side of each it is.
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
    bool outside;  // the path is on the side to which the normal points
    dvec3 normal;

    // The two sides of a thin body are two walls.
    bool is(int other_surface, const dvec3& other_normal) const;
  };

  void forget(int surface, const dvec3& normal);

  // More than twice as many as eight boxes have at a vertex which they share; the oldest give way.
  std::array<Wall, 64> walls_;
  std::size_t count_ = 0;
};

}  // namespace rondure
