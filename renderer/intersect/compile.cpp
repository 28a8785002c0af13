#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/intersect/query.h"

namespace rondure {

// Quarterings of a patch with a radial form: their boxes let enough rays by; more cost more than they save.
constexpr int radial_depth = 2;

namespace {

// Of the part of the ellipsoid that is there: within the nets, and within the ellipsoid's own box.
Box box_of(const PatchedSphere& sphere, const std::vector<Net>& nets) {
  Box hull;
  for (std::size_t k = 0; k < sphere.patches->patches.size(); ++k) {
    const auto name = static_cast<std::size_t>(sphere.name_of(static_cast<std::int32_t>(k)));
    for (const dvec4& p : points_of(nets[name])) hull.add(dvec3(p) / p.w);
  }
  const dmat3 rows = glm::transpose(sphere.ellipsoid.linear);
  const dvec3 half = (1.0 + 1e-12) * dvec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
  return {glm::max(hull.low, sphere.center - half), glm::min(hull.high, sphere.center + half)};
}

}  // namespace

void bring_near_one(Net& net) {
  double most = 0.0;
  for (const dvec4& p : points_of(net)) most = std::max(most, std::fabs(p.w));
  if (!(most > 0.0 && std::isfinite(most)) || (most > 0x1p-100 && most < 0x1p100)) return;
  const int exponent = std::ilogb(most);
  for (dvec4& p : points_of(net))
    for (int k = 0; k < 4; ++k) p[k] = std::ldexp(p[k], -exponent);
}

CompiledSurface compile(const TracedSurface& traced, int max_depth, SurfaceSpheres found) {
  const Surface& surface = traced.surface;
  CompiledSurface compiled;
  compiled.nets = &surface.patches;
  compiled.closed = surface.closed;
  compiled.solver = traced.solver;
  if (surface.ellipsoid) {
    compiled.analytic =
        std::make_unique<const PatchedSphere>(without_patches(on_principal_axes(*surface.ellipsoid)));
    const dmat3 rows = glm::transpose(compiled.analytic->ellipsoid.linear);
    const dvec3 half(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    compiled.set.boxes = {Box{-half, half}};
  } else {
    compiled.spheres = found.spheres;
    std::vector<bool> without(surface.patches.size()), radial(surface.patches.size());
    for (std::size_t k = 0; k < surface.patches.size(); ++k) {
      radial[k] = traced.solver == Solver::radial && has_radial_form(surface.patches[k]);
      without[k] = radial[k] || (!found.rest.empty() && !found.rest[k]);
    }
    compiled.set = build_leaves(surface.patches, max_depth, without);
    if (found.rest.empty() || std::find(found.rest.begin(), found.rest.end(), true) != found.rest.end()) {
      compiled.patches.reserve(surface.patches.size());
      for (const Net& net : surface.patches) compiled.patches.push_back(newton_patch(net));
    }
    for (std::size_t k = 0; k < radial.size(); ++k)
      if (radial[k])
        add_radial_leaves(surface.patches[k], static_cast<int>(k), std::min(radial_depth, max_depth / 2),
                          compiled.set, compiled.radial);
    for (const PatchedSphere& sphere : compiled.spheres)
      compiled.set.boxes.push_back(box_of(sphere, surface.patches));
  }
  for (const Box& box : compiled.set.boxes) compiled.bounds.add(box);
  return compiled;
}

bool can_cluster(const CompiledSurface& compiled) {
  const std::size_t leaves = compiled.set.leaves.size();
  // A cluster's boxes are floats.
  const double size = largest(compiled.bounds.high - compiled.bounds.low);
  return !compiled.hierarchy && compiled.spheres.empty() && leaves > 1 &&
         leaves <= LeafCluster::most_leaves && size > 1e-20 && size < 1e20 &&
         largest(glm::max(glm::abs(compiled.bounds.low), glm::abs(compiled.bounds.high))) < 1e30;
}

void make_cluster(CompiledSurface& compiled) {
  compiled.cluster = LeafCluster(compiled.set.boxes);
  compiled.set.boxes = {};
}

std::unique_ptr<Hierarchy> hierarchy_of(const CompiledSurface& compiled) {
  if (compiled.set.boxes.size() < 2) return nullptr;
  const dvec3 center = compiled.bounds.center();
  std::vector<Box> boxes;
  std::vector<LeafName> names;
  boxes.reserve(compiled.set.boxes.size()), names.reserve(compiled.set.boxes.size());
  for (const Box& box : compiled.set.boxes) {
    names.push_back({0, static_cast<unsigned>(boxes.size())});
    boxes.push_back({box.low - center, box.high - center});
  }
  return std::make_unique<Hierarchy>(center, std::move(boxes), std::move(names), visit_shared_leaf);
}

}  // namespace rondure
