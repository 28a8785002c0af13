// Ray queries against a set of surfaces: the one door between the scene and the solvers.
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "renderer/api/surface.h"
#include "renderer/intersect/ray.h"

namespace rondure {

// `radial`: in one unknown where a patch allows it (radial.h); `quadric`: in closed form where patches lie on
// an ellipsoid (sphere_solver.h). Other patches of these surfaces are met as by `newton`.
enum class Solver { newton, clipping, radial, quadric };

// A surface and the solver that meets it.
struct TracedSurface {
  Surface surface;
  Solver solver = Solver::newton;
};

struct TracerStatistics {
  std::size_t surfaces = 0, patches = 0;
  std::size_t leaves = 0;     // surfaces that share them count once; a sphere met in closed form has one
  std::size_t clustered = 0;  // of the leaves, those that are met surface by surface
  std::size_t bytes = 0;      // nets, leaves and the acceleration structure
};

// A surface that no solver can meet. The message names its index and the patch.
struct SurfaceError : std::runtime_error {
  SurfaceError(std::size_t index, const std::string& why)
      : std::runtime_error("object " + std::to_string(index) + ": " + why), surface(index), reason(why) {}

  std::size_t surface;
  std::string reason;  // without the index
};

// Immutable once built; every query is const and thread-safe, and noexcept but for `all`, which allocates.
class Tracer {
 public:
  // Throws SurfaceError when a net cannot be bounded (non-finite, or weights that change sign after
  // refinement), std::runtime_error when the surfaces together are too small or too large.
  explicit Tracer(std::vector<TracedSurface> surfaces);
  ~Tracer();
  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;

  Hit closest(const Ray& ray) const noexcept;
  bool occluded(const Ray& ray) const noexcept;
  // The same for many rays at once, hit k of ray k; the same bits, too. Both spans have one length.
  void closest(std::span<const Ray> rays, std::span<Hit> hits) const noexcept;
  void occluded(std::span<const Ray> rays, std::span<bool> occluded) const noexcept;
  // Every hit in order of t, ties by which wall is first (hit_order.h); a point on the seam of two patches of
  // one surface is reported once.
  std::vector<Hit> all(const Ray& ray) const;

  const std::vector<TracedSurface>& surfaces() const;
  // Centre and radius of a sphere that contains every surface; radius 0 and centre 0 when there are none.
  dvec3 bounding_center() const;
  double bounding_radius() const;
  TracerStatistics statistics() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace rondure
