// A ray solver as single precision would have it, to compare with: Newton's method from the leaves of a patch
// (Martin, Cohen, Fish and Shirley 2000), every number in it a float.
#pragma once

#include <optional>
#include <vector>

#include "renderer/bezier/tangents_in.h"
#include "renderer/intersect/ray.h"

namespace rondure {

struct FloatHit {
  float u = 0.0f, v = 0.0f, t = 0.0f;
  TangentsIn<float> at;
};

class FloatSolver {
 public:
  // The patch as it is in the world. Its control points are rounded to floats, the patch is cut into 8 x 8
  // leaves (64 triangles), and each has a box of floats.
  explicit FloatSolver(const Net& world);

  // The nearest hit along the ray, whose origin and direction are rounded to floats. Newton's method starts
  // at the middle of every leaf whose box the ray meets, goes on while its distance from the ray halves at
  // least, 8 steps at most, and has found a hit when that distance is no more than 16 roundings of the
  // largest coordinate and the parameters lie on the patch.
  std::optional<FloatHit> closest(const Ray& ray) const;

 private:
  struct Leaf {
    Vector3In<float> low, high;
    float u, v;  // of its middle
  };

  Net net_;  // of floats
  std::vector<Leaf> leaves_;
  float size_ = 0.0f;  // largest coordinate

  void add_leaf(const std::vector<dvec4>& points, dvec2 middle);
};

}  // namespace rondure
