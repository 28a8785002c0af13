#include "renderer/intersect/tracer.h"

#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/crossing.h"
#include "renderer/intersect/ellipsoid.h"
#include "renderer/intersect/hierarchy.h"
#include "renderer/intersect/radial.h"
#include "renderer/intersect/slab.h"
#include "renderer/intersect/solve_leaf.h"
#include "renderer/intersect/surface_crossing.h"
#include "renderer/intersect/twins.h"
#include "renderer/parallel/parallel_for.h"

namespace rondure {
namespace {

// What a solver needs of one surface, beside its nets.
struct CompiledSurface {
  LeafSet set;                      // empty for an analytic surface
  Box bounds;                       // of all leaves
  std::vector<RadialPiece> radial;  // of the last leaves
  std::optional<Ellipsoid> ellipsoid;
  std::unique_ptr<Hierarchy> hierarchy;  // of the leaves, where several surfaces share them
  const std::vector<Net>* nets = nullptr;
  Solver solver = Solver::newton;
};

constexpr std::size_t cells_per_query = 1 << 15;

enum class Mode { closest, any, all };

// One ray's way through the hierarchy; lives on the stack of the query.
struct Query {
  const CompiledSurface* const* compiled;  // one a surface
  const dvec3* origins;                    // one a surface
  const Ray* ray;
  Mode mode;
  Entry entry{};          // into the hierarchy that is being traversed
  unsigned instance = 0;  // whose hierarchy that is, if it is not the scene's
  unsigned local_surface = ~0u;
  bool local_valid = false;
  LocalRay local{};
  dvec3 inverse_direction{0.0};
  Hit best{};
  FirstOrder<dvec4> best_first;  // the patch at `best`
  SolverCounts* counts;
  bool found = false;
  std::vector<Hit>* hits = nullptr;
  std::vector<int>* signs = nullptr;
};

bool nearer(const Hit& a, const Hit& b) {
  if (a.t != b.t) return a.t < b.t;
  return a.surface != b.surface ? a.surface < b.surface : a.patch < b.patch;
}

enum class Taken { no, noted, nearest, settled };

// Takes one crossing into the query; `normal()` is the unit normal there, asked for when every hit counts.
// `nearest`: it is the best so far, and its normal still to come. `settled`: an occlusion query is answered.
template <class Normal>
Taken take(Query& q, unsigned surface, int patch, dvec2 uv, const dvec3& point, const Normal& normal,
           const Crossing& c, float& far) {
  Hit hit;
  const dvec3& frame = q.origins[surface];
  if (!accept(*q.ray, q.local, static_cast<int>(surface), frame, c, hit.t)) return Taken::no;
  q.found = true;
  if (q.mode == Mode::any) return Taken::settled;
  hit.t_error = c.s_error * q.local.scale;
  hit.surface = static_cast<int>(surface), hit.patch = patch, hit.u = uv.x, hit.v = uv.y;
  if (q.mode == Mode::all) {
    hit.point = frame + point, hit.normal = normal();
    q.hits->push_back(hit);
    q.signs->push_back(c.sign);
    return Taken::noted;
  }
  if (q.best && !nearer(hit, q.best)) return Taken::noted;
  hit.point = frame + point;
  q.best = hit;
  far = std::min(far, q.entry.round_far(hit.t + hit.t_error));
  return Taken::nearest;
}

// The same for a root on a leaf, `s` being the patch there. True when an occlusion query is answered.
bool take_root(Query& q, unsigned surface, const Leaf& leaf, const Net& net, const Root& root,
               const FirstOrder<dvec4>& s, float& far) {
  dvec3 point;
  const Crossing c = cross_surface(leaf, net, q.local, root, s, point);
  const auto normal = [&] { return unit_normal(net, root.u, root.v, s); };
  const Taken taken = take(q, surface, leaf.patch, {root.u, root.v}, point, normal, c, far);
  if (taken == Taken::nearest) q.best_first = s;
  return taken == Taken::settled;
}

bool localise(Query& q, unsigned surface) {
  if (q.local_surface != surface) {
    q.local_surface = surface;
    q.local_valid = make_local_ray(q.ray->origin, q.ray->direction, q.origins[surface], q.local);
    q.inverse_direction = 1.0 / q.local.direction;
  }
  return q.local_valid;
}

bool visit_leaf(Query& q, unsigned surface, unsigned leaf_index, float& far) noexcept {
  if (!localise(q, surface)) return false;
  const CompiledSurface& compiled = *q.compiled[surface];

  if (compiled.ellipsoid) {
    EllipsoidHit hits[2];
    const int count = intersect_ellipsoid(*compiled.ellipsoid, q.local, hits);
    for (int k = 0; k < count; ++k) {
      const double error = ellipsoid_error(*compiled.ellipsoid);
      const Crossing c =
          make_crossing(q.local, hits[k].point, hits[k].normal, error, compiled.ellipsoid->extent, false);
      const auto normal = [&] { return hits[k].normal; };
      const Taken taken = take(q, surface, 0, dvec2(0.0), hits[k].point, normal, c, far);
      if (taken == Taken::settled) return true;
      if (taken == Taken::nearest) q.best.normal = hits[k].normal;
    }
    return false;
  }

  const Leaf& leaf = compiled.set.leaves[leaf_index];
  const Net& net = (*compiled.nets)[static_cast<std::size_t>(leaf.patch)];
  const std::size_t ordinary = compiled.set.leaves.size() - compiled.radial.size();
  if (leaf_index < ordinary && compiled.solver != Solver::clipping) {
    NewtonRoot found;
    const NewtonVerdict verdict = solve_by_newton(leaf, net, q.local, found, *q.counts);
    if (verdict == NewtonVerdict::root)
      return take_root(q, surface, leaf, net, found.root, found.surface, far);
    if (verdict == NewtonVerdict::none) return false;
  }
  // The hierarchy's boxes are padded for the whole scene's size. On a small object in a large scene that lets
  // every ray by; in double the leaf's own box does not.
  if (!meets_box(q.local, q.inverse_direction, compiled.set.boxes[leaf_index])) return false;
  static thread_local std::vector<Root> roots;  // one visit's; kept so that nothing is allocated
  roots.clear();
  if (leaf_index >= ordinary)
    solve_radial(compiled.radial[leaf_index - ordinary], leaf, net, q.local, roots);
  else
    search_leaf(leaf, net, q.local, roots, *q.counts);
  for (const Root& root : roots)
    if (take_root(q, surface, leaf, net, root, net_first(net, root.u, root.v), far)) return true;
  return false;
}

bool visit_shared_leaf(void* pointer, unsigned, unsigned leaf, float& far) noexcept {
  Query& q = *static_cast<Query*>(pointer);
  return visit_leaf(q, q.instance, leaf, far);
}

// A surface that shares its leaves with others, in its own frame.
bool visit_instance(Query& q, unsigned surface, float& far) noexcept {
  if (!localise(q, surface)) return false;
  const Hierarchy& hierarchy = *q.compiled[surface]->hierarchy;
  const Entry outer = q.entry;
  const double t_max = q.best ? std::min(q.ray->t_max, q.best.t + q.best.t_error) : q.ray->t_max;
  if (!hierarchy.enter(q.local, q.ray->t_min, t_max, q.entry)) return false;
  q.instance = surface;
  bool settled = false;
  if (q.mode == Mode::any)
    settled = hierarchy.visit_any(q.local, q.entry, &q);
  else
    hierarchy.visit_all(q.local, q.entry, &q);
  q.entry = outer;
  if (q.best) far = std::min(far, outer.round_far(q.best.t + q.best.t_error));
  return settled;
}

bool visit(void* pointer, unsigned surface, unsigned leaf, float& far) noexcept {
  Query& q = *static_cast<Query*>(pointer);
  return leaf == LeafName::whole ? visit_instance(q, surface, far) : visit_leaf(q, surface, leaf, far);
}

}  // namespace

struct Tracer::Implementation {
  std::vector<TracedSurface> surfaces;
  std::vector<CompiledSurface> distinct;         // those that are the first of their twins (twins.h)
  std::vector<const CompiledSurface*> compiled;  // one a surface, among these
  std::vector<dvec3> origins;
  std::size_t leaf_count = 0;
  std::unique_ptr<Hierarchy> hierarchy;

  // Meets every leaf that the ray may hit. True when an occlusion query is settled.
  bool visit(Query& q) const {
    LocalRay global;
    if (!hierarchy || !make_local_ray(q.ray->origin, q.ray->direction, hierarchy->center(), global))
      return false;
    if (!hierarchy->enter_at_center(global, q.ray->t_min, q.ray->t_max, q.entry)) return false;
    if (q.mode == Mode::any) return hierarchy->visit_any(global, q.entry, &q);
    hierarchy->visit_all(global, q.entry, &q);
    return false;
  }

  // What only a hit that is reported needs: the parameters of an analytic surface.
  void finish(Hit& hit) const {
    const auto index = static_cast<std::size_t>(hit.surface);
    const CompiledSurface& surface = *compiled[index];
    if (!surface.ellipsoid) return;
    const dvec2 p = ellipsoid_parameters(*surface.ellipsoid, hit.point - origins[index]);
    hit.u = p.x, hit.v = p.y;
  }

  // And the normal of the nearest.
  void finish(Query& q) const {
    finish(q.best);
    const auto index = static_cast<std::size_t>(q.best.surface);
    if (compiled[index]->ellipsoid) return;
    const Net& net = (*compiled[index]->nets)[static_cast<std::size_t>(q.best.patch)];
    q.best.normal = unit_normal(net, q.best.u, q.best.v, q.best_first);
  }

  Query make_query(const Ray& ray, Mode mode) const {
    Query q{};
    // A net on which a ray takes this many cells is degenerate; it must not stop the program.
    q.counts = &thread_counts();
    SearchCounts& search = q.counts->search;
    search.limit = search.cells + cells_per_query;
    q.compiled = compiled.data(), q.origins = origins.data(), q.ray = &ray, q.mode = mode;
    return q;
  }
};

namespace {

// Leaves beyond this many cost more memory than they save time; with more patches, each gets fewer.
constexpr double leaf_budget = 0x1p20;
constexpr int deepest = 11, shallowest = 2;
// Quarterings of a patch with a radial form: their boxes let enough rays by; more cost more than they save.
constexpr int radial_depth = 2;

CompiledSurface compile(const TracedSurface& traced, int max_depth) {
  const Surface& surface = traced.surface;
  CompiledSurface compiled;
  compiled.nets = &surface.patches;
  compiled.solver = traced.solver;
  if (surface.ellipsoid) {
    compiled.ellipsoid.emplace(*surface.ellipsoid);
    const dmat3 rows = glm::transpose(compiled.ellipsoid->linear);
    const dvec3 half(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    compiled.set.boxes = {Box{-half, half}};
  } else {
    std::vector<bool> radial;
    for (const Net& net : surface.patches)
      radial.push_back(traced.solver == Solver::radial && has_radial_form(net));
    compiled.set = build_leaves(surface.patches, max_depth, radial);
    for (std::size_t k = 0; k < radial.size(); ++k)
      if (radial[k])
        add_radial_leaves(surface.patches[k], static_cast<int>(k), std::min(radial_depth, max_depth / 2),
                          compiled.set, compiled.radial);
  }
  for (const Box& box : compiled.set.boxes) compiled.bounds.add(box);
  return compiled;
}

// Of the leaves of surfaces that share them; none of a single leaf.
std::unique_ptr<Hierarchy> hierarchy_of(const CompiledSurface& compiled) {
  if (compiled.set.boxes.size() < 2) return nullptr;
  const dvec3 center = compiled.bounds.center();
  std::vector<Box> boxes;
  std::vector<LeafName> names;
  for (const Box& box : compiled.set.boxes) {
    names.push_back({0, static_cast<unsigned>(boxes.size())});
    boxes.push_back({box.low - center, box.high - center});
  }
  return std::make_unique<Hierarchy>(center, std::move(boxes), std::move(names), visit_shared_leaf);
}

}  // namespace

Tracer::Tracer(std::vector<TracedSurface> surfaces) : implementation_(std::make_unique<Implementation>()) {
  Implementation& self = *implementation_;
  self.surfaces = std::move(surfaces);
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

  self.distinct.resize(firsts.size());
  self.compiled.resize(count);
  std::vector<std::string> errors(firsts.size());
  parallel_for(firsts.size(), [&](std::size_t k) {
    try {
      CompiledSurface& compiled = self.distinct[k];
      self.compiled[firsts[k]] = &compiled;
      compiled = compile(self.surfaces[firsts[k]], depth);
      if (twin_counts[firsts[k]] > 1) compiled.hierarchy = hierarchy_of(compiled);
    } catch (const std::runtime_error& error) {
      errors[k] = error.what();
    }
  });
  // The first in the scene's order, whichever thread met its own first.
  for (std::size_t k = 0; k < firsts.size(); ++k)
    if (!errors[k].empty()) throw SurfaceError(firsts[k], errors[k]);

  Box world;
  for (unsigned k = 0; k < count; ++k) {
    self.compiled[k] = self.compiled[twins[k]];
    const dvec3& origin = self.surfaces[k].surface.origin;
    self.origins.push_back(origin);
    const Box& bounds = self.compiled[k]->bounds;
    if (!bounds.empty()) world.add(Box{bounds.low + origin, bounds.high + origin});
    if (twins[k] == k) self.leaf_count += self.compiled[k]->set.boxes.size();
  }
  if (world.empty()) return;
  const dvec3 center = world.center();
  std::vector<Box> boxes;
  std::vector<LeafName> names;
  for (unsigned k = 0; k < count; ++k) {
    const CompiledSurface& compiled = *self.compiled[k];
    const dvec3 shift = self.origins[k] - center;
    const auto add = [&](const Box& box, unsigned leaf) {
      boxes.push_back({box.low + shift, box.high + shift});
      names.push_back({k, leaf});
    };
    if (compiled.hierarchy) {
      add(compiled.bounds, LeafName::whole);
      continue;
    }
    for (unsigned leaf = 0; leaf < compiled.set.boxes.size(); ++leaf) add(compiled.set.boxes[leaf], leaf);
  }
  self.hierarchy = std::make_unique<Hierarchy>(center, std::move(boxes), std::move(names), visit);
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

Hit Tracer::closest(const Ray& ray) const noexcept {
  Query q = implementation_->make_query(ray, Mode::closest);
  implementation_->visit(q);
  if (q.best) implementation_->finish(q);
  return q.best;
}

bool Tracer::occluded(const Ray& ray) const noexcept {
  Query q = implementation_->make_query(ray, Mode::any);
  return implementation_->visit(q);
}

std::vector<Hit> Tracer::all(const Ray& ray) const {
  std::vector<Hit> hits;
  std::vector<int> signs;
  Query q = implementation_->make_query(ray, Mode::all);
  q.hits = &hits, q.signs = &signs;
  implementation_->visit(q);

  std::vector<std::size_t> order(hits.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return nearer(hits[a], hits[b]); });
  std::vector<Hit> out;
  std::vector<int> out_signs;
  for (const std::size_t k : order) {
    // Neighbouring patches (and leaves) both report a point on their seam: same surface, same crossing, same
    // t to rounding.
    bool known = false;
    for (std::size_t j = out.size(); j-- > 0 && !known;) {
      if (hits[k].t - out[j].t > hits[k].t_error + out[j].t_error) continue;
      const bool same_way = signs[k] == out_signs[j] || signs[k] == 0 || out_signs[j] == 0;
      known = out[j].surface == hits[k].surface && same_way;
    }
    if (known) continue;
    out.push_back(hits[k]);
    out_signs.push_back(signs[k]);
  }
  for (Hit& hit : out) implementation_->finish(hit);
  return out;
}

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
  for (std::size_t k = 0; k < self.surfaces.size(); ++k) {
    s.patches += self.surfaces[k].surface.patches.size();
    for (const Net& net : self.surfaces[k].surface.patches)
      s.bytes += sizeof(Net) + points_of(net).size() * sizeof(dvec4);
  }
  for (const CompiledSurface& compiled : self.distinct) {
    s.bytes += compiled.set.leaves.size() * (sizeof(Leaf) + sizeof(Box));
    if (compiled.hierarchy) s.bytes += compiled.hierarchy->bytes();
  }
  if (self.hierarchy) s.bytes += self.hierarchy->bytes();
  return s;
}

}  // namespace rondure
