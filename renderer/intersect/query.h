// One ray's way through the surfaces: what has been found so far, and how a leaf adds to it.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "renderer/intersect/ellipsoid.h"
#include "renderer/intersect/hierarchy.h"
#include "renderer/intersect/leaf.h"
#include "renderer/intersect/leaf_cluster.h"
#include "renderer/intersect/patched_spheres.h"
#include "renderer/intersect/radial.h"
#include "renderer/intersect/solve_leaf.h"
#include "renderer/intersect/sphere_ray.h"
#include "renderer/intersect/tracer.h"

namespace rondure {

// What a solver needs of one surface, beside its nets.
struct CompiledSurface {
  LeafSet set;          // one box and no leaf for an analytic surface; no box where there is a cluster
  LeafCluster cluster;  // of the leaves, where there are many small surfaces
  const std::vector<Net>* nets = nullptr;
  std::vector<NewtonPatch> patches;  // of the nets, where there are leaves
  Solver solver = Solver::newton;
  bool closed = false;
  std::vector<RadialPiece> radial;         // of the last leaves
  std::span<const PatchedSphere> spheres;  // of the boxes after all leaves
  // The surface itself, in place of patches; a sphere where that has a radius.
  std::unique_ptr<const PatchedSphere> analytic;
  std::unique_ptr<Hierarchy> hierarchy;  // of the leaves, where several surfaces share them
  Box bounds;                            // of all leaves

  // The one sphere or ellipsoid that is all.
  const PatchedSphere* lone_sphere() const {
    return analytic ? analytic.get() : set.boxes.size() == 1 && spheres.size() == 1 ? &spheres[0] : nullptr;
  }
};

// A net whose weights are so small or large that products of two of their size would leave the numbers, in
// units of its largest: a power of two, so that the surface and its points stay the same bits.
void bring_near_one(Net& net);

// Throws std::runtime_error where a net cannot be bounded. `max_depth`: halvings of a patch. `found`: what
// its patches lie on, if that is asked for.
CompiledSurface compile(const TracedSurface& traced, int max_depth, SurfaceSpheres found);

// One that may share what is compiled with others.
struct PlacedSurface {
  dvec3 origin{0.0};
  const PatchedSphere* sphere = nullptr;  // where that, and no other ellipsoid, is all
  const CompiledSurface* compiled = nullptr;
  double doubt = 1.0;                // most_doubt (hit_order.h)
  std::span<const std::byte> boxes;  // of its cluster: what a ray needs first, and has to wait for
};

// Whether the surface's boxes are few and each a leaf's.
bool can_cluster(const CompiledSurface& compiled);
void make_cluster(CompiledSurface& compiled);

// Of the leaves of surfaces that share them; none of a single leaf.
std::unique_ptr<Hierarchy> hierarchy_of(const CompiledSurface& compiled);

enum class Mode { closest, any, all };

// Lives on the stack of the query.
struct Query {
  const PlacedSurface* surfaces;
  const Ray* ray;
  Mode mode;
  Entry entry{};          // into the hierarchy that is being traversed
  unsigned instance = 0;  // whose hierarchy that is, if it is not the scene's
  // The ray's local forms: the direction is the same in all, the base changes with the surface.
  LocalRay local{};
  static constexpr unsigned every_surface = ~0u, no_surface = ~1u;
  unsigned local_surface = no_surface;  // in whose frame the base is
  bool local_valid = false;
  bool has_normals = false, has_distances = false;
  Hit best{};
  double tied_until = INFINITY;    // how far hits are that may be tied with that, or with one that is
  int ties = 0;                    // how often another wall was as near
  SolverCounts* counts = nullptr;  // once a net has been met
  std::vector<Hit>* hits = nullptr;
  std::vector<int>* signs = nullptr;
};

// Meets one leaf (an analytic surface has one, 0). `far` is lowered where a hit narrows the search. True when
// an occlusion query is settled.
bool visit_leaf(Query& query, unsigned surface, unsigned leaf, float& far) noexcept;

// The same for hierarchies, `query` being a Query: of a whole scene, and of a surface that shares its leaves.
bool visit_by_name(void* query, unsigned surface, unsigned leaf, float& far) noexcept;
bool visit_shared_leaf(void* query, unsigned, unsigned leaf, float& far) noexcept;

// What only a hit that is reported needs: the parameters of an analytic surface.
void finish(const PlacedSurface& surface, Hit& hit);

}  // namespace rondure
