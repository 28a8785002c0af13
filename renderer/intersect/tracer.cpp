#include "renderer/intersect/tracer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <stdexcept>
#include <unordered_set>

#include "renderer/intersect/hit_order.h"
#include "renderer/intersect/newton_packets.h"
#include "renderer/intersect/query.h"
#include "renderer/intersect/short_ray.h"
#include "renderer/intersect/sphere_packets.h"
#include "renderer/intersect/twins.h"
#include "renderer/parallel/parallel_for.h"

namespace rondure {

struct Tracer::Implementation {
  std::vector<TracedSurface> surfaces;
  std::vector<CompiledSurface> distinct;  // those that are the first of their twins (twins.h)
  std::vector<PatchedSphere> spheres;     // of all these
  std::vector<PlacedSurface> placed;      // all, in order
  std::size_t leaf_count = 0;
  std::unique_ptr<Hierarchy> hierarchy;
  bool one_frame = false;  // the surfaces' origins are all at the hierarchy's centre

  std::vector<LeafName> few;          // of so few leaves that no hierarchy pays
  std::optional<SphereTarget> alone;  // where a sphere is all
  std::optional<PacketTarget> packets;

  // Meets every leaf that the ray may hit. True when an occlusion query is settled.
  bool visit(Query& q) const {
    if (!hierarchy || !is_finite(q.ray->origin) || !set_direction(q.ray->direction, q.local)) return false;
    if (!few.empty()) {
      float far = INFINITY;
      for (const LeafName& name : few)
        if (visit_by_name(&q, name.surface, name.leaf, far)) return true;
      return false;
    }
    if (one_frame) q.local_surface = Query::every_surface, q.local_valid = true;
    LocalRay other;
    LocalRay& about_center = one_frame ? q.local : (other = q.local);
    if (!set_base(q.ray->origin, hierarchy->center(), about_center)) return false;
    if (!hierarchy->enter_at_center(about_center, q.ray->t_min, q.ray->t_max, q.entry)) return false;
    if (q.mode == Mode::any) return hierarchy->visit_any(q.local, q.entry, &q);
    hierarchy->visit_all(q.local, q.entry, &q);
    return false;
  }

  Hit closest(const Ray& ray) const {
    if (is_short(ray)) {
      const Hit hit = closest(lengthened(ray));
      return can_shorten(hit) ? shortened(hit) : Hit{};
    }
    Query q = make_query(ray, Mode::closest);
    visit(q);
    return first_of(q);
  }

  Hit closest(const Ray& ray, const PreparedRay& prepared) const {
    Query q = make_query(ray, Mode::closest);
    q.local = prepared.local, q.entry = prepared.entry, q.has_normals = true;
    if (one_frame) q.local_surface = Query::every_surface, q.local_valid = true;
    hierarchy->visit_all(q.local, q.entry, &q);
    return first_of(q);
  }

  // Which of three or more that are tied comes first, is settled in the order of all that are as near. Where
  // the ray goes on from a wall, what its path remembers tells more (passed_walls.h).
  Hit first_of(Query& q) const {
    if (q.ties > 1 && q.ray->start.surface < 0) {
      Ray near = *q.ray;
      near.t_max = std::min(near.t_max, q.tied_until);
      // A search that was given up may have found more the first time.
      if (const std::vector<Hit> tied = all(near); !tied.empty()) return tied.front();
    }
    if (q.best) finish_hit(q.best);
    return q.best;
  }

  std::vector<Hit> all(const Ray& ray) const {
    std::vector<Hit> hits;
    if (is_short(ray)) {
      for (const Hit& hit : all(lengthened(ray)))
        if (can_shorten(hit)) hits.push_back(shortened(hit));
      return hits;
    }
    std::vector<int> signs;
    Query q = make_query(ray, Mode::all);
    q.hits = &hits, q.signs = &signs;
    visit(q);
    hits = in_order(q, hits, signs);
    for (Hit& hit : hits) finish_hit(hit);
    return hits;
  }

  // As the public one, where packets are met.
  void closest(std::span<const Ray> rays, std::span<Hit> hits) const {
    static thread_local PreparedRay prepared[most_in_packet];  // whose numbers nobody need initialise
    PacketAnswer answers[most_in_packet];
    for (std::size_t first = 0; first < rays.size(); first += most_in_packet) {
      const std::size_t count = std::min(most_in_packet, rays.size() - first);
      closest_in_packet(*packets, &rays[first], count, &hits[first], prepared, answers);
      thread_counts().met_in_packets +=
          static_cast<std::size_t>(std::count(answers, answers + count, PacketAnswer::done));
      for (std::size_t k = 0; k < count; ++k)
        if (answers[k] == PacketAnswer::prepared)
          hits[first + k] = closest(rays[first + k], prepared[k]);
        else if (answers[k] == PacketAnswer::unknown)
          hits[first + k] = closest(rays[first + k]);
    }
  }

  void finish_hit(Hit& hit) const { finish(placed[static_cast<std::size_t>(hit.surface)], hit); }

  Query make_query(const Ray& ray, Mode mode) const { return Query{placed.data(), &ray, mode}; }
};

namespace {

// Leaves beyond this many cost more memory than they save time; with more patches, each gets fewer.
constexpr double leaf_budget = 0x1p20;
constexpr int deepest = 11, shallowest = 2;
// Packets do not pay for fewer rays, nor where these are so many leaves apart.
constexpr std::size_t few_rays = 4;
constexpr double leaves_apart = 4.0;
// Beyond so many leaves of small surfaces these are met surface by surface (leaf_cluster.h).
constexpr std::size_t clustered_leaves = 1 << 18;
constexpr std::size_t few_leaves = 2;  // are met one by one

}  // namespace

Tracer::Tracer(std::vector<TracedSurface> surfaces) : implementation_(std::make_unique<Implementation>()) {
  Implementation& self = *implementation_;
  self.surfaces = std::move(surfaces);
  for (TracedSurface& traced : self.surfaces)
    for (Net& net : traced.surface.patches) bring_near_one(net);
  const auto count = static_cast<unsigned>(self.surfaces.size());
  const std::vector<unsigned> twins = find_twins(self.surfaces);
  std::vector<unsigned> firsts, twin_counts(count);
  std::size_t patches = 1;
  for (unsigned k = 0; k < count; ++k) {
    if (++twin_counts[twins[k]]; twins[k] != k) continue;
    firsts.push_back(k);
    patches += self.surfaces[k].surface.patches.size();
  }
  const int depth = std::clamp(static_cast<int>(std::log2(leaf_budget / static_cast<double>(patches))),
                               shallowest, deepest);

  std::vector<const std::vector<Net>*> nets;
  for (const unsigned k : firsts) {
    const TracedSurface& traced = self.surfaces[k];
    nets.push_back(traced.solver == Solver::quadric && !traced.surface.ellipsoid ? &traced.surface.patches
                                                                                 : nullptr);
  }
  SceneSpheres found = patched_spheres(nets);
  self.spheres = std::move(found.spheres);

  self.distinct.resize(firsts.size());
  self.placed.resize(count);
  std::vector<std::string> errors(firsts.size());
  parallel_for(firsts.size(), [&](std::size_t k) {
    try {
      CompiledSurface& compiled = self.distinct[k];
      self.placed[firsts[k]].compiled = &compiled;
      compiled = compile(self.surfaces[firsts[k]], depth, std::move(found.surfaces[k]));
      if (twin_counts[firsts[k]] > 1) compiled.hierarchy = hierarchy_of(compiled);
    } catch (const std::runtime_error& error) {
      errors[k] = error.what();
    }
  });
  // The first in the scene's order, whichever thread met its own first.
  for (std::size_t k = 0; k < firsts.size(); ++k)
    if (!errors[k].empty()) throw SurfaceError(firsts[k], errors[k]);

  std::size_t leaves = 0;
  for (const CompiledSurface& compiled : self.distinct)
    if (can_cluster(compiled)) leaves += compiled.set.leaves.size();
  for (const CompiledSurface& compiled : self.distinct) self.leaf_count += compiled.set.boxes.size();
  if (leaves > clustered_leaves)
    parallel_for(self.distinct.size(), [&](std::size_t k) {
      if (can_cluster(self.distinct[k])) make_cluster(self.distinct[k]);
    });

  Box world;
  double widest = 0.0, most = 0.0;
  for (unsigned k = 0; k < count; ++k) {
    PlacedSurface& placed = self.placed[k];
    placed.compiled = self.placed[twins[k]].compiled;
    placed.origin = self.surfaces[k].surface.origin;
    placed.boxes = placed.compiled->cluster.memory();
    const CompiledSurface& compiled = *placed.compiled;
    if (const PatchedSphere* sphere = compiled.lone_sphere(); sphere && sphere->radius > 0.0)
      placed.sphere = sphere;
    if (const Box& bounds = compiled.bounds; !bounds.empty()) {
      world.add(Box{bounds.low + placed.origin, bounds.high + placed.origin});
      widest = std::max(widest, extent_of(placed));
    }
  }
  if (world.empty()) return;
  for (PlacedSurface& placed : self.placed) most = std::max(most, placed.doubt = most_doubt(placed, widest));
  // A common origin that is in the middle, or nearly, spares each ray a second local form.
  dvec3 center = world.center();
  const dvec3 common = self.placed.front().origin;
  const bool all_there = std::all_of(self.placed.begin(), self.placed.end(),
                                     [&](const PlacedSurface& p) { return p.origin == common; });
  self.one_frame = all_there && glm::distance(common, center) < 0x1p-4 * glm::distance(world.low, world.high);
  if (self.one_frame) center = common;
  const auto name_of_all = [](const PlacedSurface& s) {
    return s.sphere                       ? LeafName::sphere
           : s.compiled->hierarchy        ? LeafName::whole
           : !s.compiled->cluster.empty() ? LeafName::cluster
                                          : 0;
  };
  std::size_t box_count = 0;
  for (const PlacedSurface& s : self.placed)
    box_count += name_of_all(s) != 0 ? 1 : s.compiled->set.boxes.size();
  std::vector<Box> boxes;
  std::vector<LeafName> names;
  boxes.reserve(box_count), names.reserve(box_count);
  for (unsigned k = 0; k < count; ++k) {
    const CompiledSurface& compiled = *self.placed[k].compiled;
    const dvec3 shift = self.placed[k].origin - center;
    const auto add = [&](const Box& box, unsigned leaf) {
      boxes.push_back({box.low + shift, box.high + shift});
      names.push_back({k, leaf});
    };
    if (const unsigned name = name_of_all(self.placed[k]); name != 0) {
      add(compiled.bounds, name);
      continue;
    }
    for (unsigned leaf = 0; leaf < compiled.set.boxes.size(); ++leaf) add(compiled.set.boxes[leaf], leaf);
  }
  if (names.size() <= few_leaves && names.front().leaf != LeafName::whole &&
      names.back().leaf != LeafName::whole)
    self.few = names;
  if (self.few.size() == 1 && self.few[0].leaf == LeafName::sphere) {
    const unsigned k = self.few[0].surface;
    self.alone = target_at(*self.placed[k].sphere, self.placed[k].origin, static_cast<int>(k));
  }
  double size = 0.0;
  for (const Box& box : boxes) size += glm::distance(box.low, box.high) / static_cast<double>(boxes.size());
  self.hierarchy = std::make_unique<Hierarchy>(center, std::move(boxes), std::move(names), visit_by_name);
  if (self.few.empty() && self.hierarchy->packet_width() > 0 &&
      std::all_of(self.placed.begin(), self.placed.end(),
                  [](const PlacedSurface& s) { return can_meet_packets(s); }))
    self.packets =
        PacketTarget{self.placed.data(), self.hierarchy.get(), self.one_frame,
                     leaves_apart * size * self.hierarchy->unit(), count == 1 ? 0.0 : most + own_roundings};
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

Hit Tracer::closest(const Ray& ray) const noexcept {
  if (implementation_->alone) {
    Hit hit;
    const RayAnswer answer = closest_on_sphere(*implementation_->alone, ray, INFINITY, hit);
    if (answer == RayAnswer::hit) implementation_->finish_hit(hit);
    if (answer != RayAnswer::unknown) return hit;
  }
  return implementation_->closest(ray);
}

bool Tracer::occluded(const Ray& ray) const noexcept {
  if (implementation_->alone)
    if (const RayAnswer answer = sphere_occludes(*implementation_->alone, ray); answer != RayAnswer::unknown)
      return answer == RayAnswer::hit;
  // Beyond the largest t there is nothing that a short ray could be kept from.
  if (is_short(ray)) return static_cast<bool>(implementation_->closest(ray));
  Query q = implementation_->make_query(ray, Mode::any);
  return implementation_->visit(q);
}

void Tracer::closest(std::span<const Ray> rays, std::span<Hit> hits) const noexcept {
  const Implementation& self = *implementation_;
  if (!self.alone) {
    if (self.packets && rays.size() >= few_rays)
      self.closest(rays, hits);
    else
      for (std::size_t k = 0; k < rays.size(); ++k) hits[k] = self.closest(rays[k]);
    return;
  }
  constexpr std::size_t some = 16;
  unsigned char done[some];
  for (std::size_t first = 0; first < rays.size(); first += some) {
    const std::size_t count = std::min(some, rays.size() - first);
    closest_on_sphere(*self.alone, &rays[first], count, &hits[first], done);
    for (std::size_t k = 0; k < count; ++k)
      if (!done[k])
        hits[first + k] = closest(rays[first + k]);
      else if (hits[first + k])
        self.finish_hit(hits[first + k]);
  }
}

void Tracer::occluded(std::span<const Ray> rays, std::span<bool> occluded) const noexcept {
  for (std::size_t k = 0; k < rays.size(); ++k) occluded[k] = this->occluded(rays[k]);
}

std::vector<Hit> Tracer::all(const Ray& ray) const { return implementation_->all(ray); }

const std::vector<TracedSurface>& Tracer::surfaces() const { return implementation_->surfaces; }
dvec3 Tracer::bounding_center() const {
  return implementation_->hierarchy ? implementation_->hierarchy->center() : dvec3(0.0);
}
double Tracer::bounding_radius() const {
  return implementation_->hierarchy ? implementation_->hierarchy->radius() : 0.0;
}

TracerStatistics Tracer::statistics() const {
  const Implementation& self = *implementation_;
  TracerStatistics s;
  s.surfaces = self.surfaces.size();
  s.leaves = self.leaf_count;
  s.bytes = self.placed.size() * sizeof(PlacedSurface);
  for (std::size_t k = 0; k < self.surfaces.size(); ++k) {
    s.patches += self.surfaces[k].surface.patches.size();
    for (const Net& net : self.surfaces[k].surface.patches)
      s.bytes += sizeof(Net) + points_of(net).size() * sizeof(dvec4);
  }
  std::unordered_set<const SpherePatches*> shared;
  for (const CompiledSurface& compiled : self.distinct) {
    if (!compiled.cluster.empty()) s.clustered += compiled.set.leaves.size();
    s.bytes += sizeof(CompiledSurface) + compiled.set.leaves.size() * sizeof(Leaf) +
               compiled.set.boxes.size() * sizeof(Box) + compiled.cluster.memory().size() +
               compiled.patches.size() * sizeof(NewtonPatch);
    for (const PatchedSphere& sphere : compiled.spheres) {
      s.bytes += sizeof(sphere) + sphere.names.size() * sizeof(sphere.names[0]);
      if (shared.insert(sphere.patches.get()).second) s.bytes += sphere.patches->bytes();
    }
    for (const RadialPiece& piece : compiled.radial)
      s.bytes += sizeof(piece) + piece.weights.size() * sizeof(piece.weights[0]);
    if (compiled.analytic) s.bytes += sizeof(PatchedSphere);
    if (compiled.hierarchy) s.bytes += compiled.hierarchy->bytes();
  }
  if (self.hierarchy) s.bytes += self.hierarchy->bytes();
  return s;
}

}  // namespace rondure
