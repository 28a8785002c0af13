// What people settle for: Embree's own sphere, an analytic sphere as user geometry, a fine triangle mesh.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "renderer/intersect/ray.h"

namespace rondure::bench {

class EmbreeBaseline {
 public:
  enum class Kind { sphere_point, user_sphere, triangle_mesh };

  // A unit sphere about the origin. `triangles`: about how many, for the mesh.
  explicit EmbreeBaseline(Kind kind, std::size_t triangles = 0);
  ~EmbreeBaseline();

  // Number of hits; `worst_error`, when given, receives the largest | |o + t d| - 1 |.
  std::size_t trace(const std::vector<Ray>& rays, double* worst_error = nullptr) const;
  // The same in packets of 16; 0 where the machine's Embree has none of that size.
  std::size_t trace_packets(const std::vector<Ray>& rays) const;
  std::size_t bytes() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace rondure::bench
