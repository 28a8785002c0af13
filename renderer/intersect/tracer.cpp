#include "renderer/intersect/tracer.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>

#include "renderer/bezier/rational.h"
#include "renderer/intersect/crossing.h"
#include "renderer/intersect/ellipsoid.h"
#include "renderer/intersect/embree_scene.h"
#include "renderer/intersect/radial.h"
#include "renderer/intersect/slab.h"
#include "renderer/intersect/solve_leaf.h"
#include "renderer/intersect/surface_crossing.h"

namespace rondure {
namespace {

// What a solver needs of one surface, beside its nets.
struct CompiledSurface {
  LeafSet set;                      // empty for an analytic surface
  std::vector<RadialPiece> radial;  // of the last leaves
  std::optional<Ellipsoid> ellipsoid;
  dvec3 frame{0.0};
};

constexpr std::size_t cells_per_query = 1 << 15;

enum class Mode { closest, any, all };

// One ray's way through the hierarchy; lives on the stack of the query.
struct Query {
  const std::vector<TracedSurface>* surfaces;
  const std::vector<CompiledSurface>* compiled;
  const Ray* ray;
  Mode mode;
  double far_origin;  // t of the traversal's origin; the traversal's direction is the ray's times 1 /
                      // `far_scale`
  double far_scale;
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
  const dvec3& frame = (*q.compiled)[surface].frame;
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
  far = std::min(far, round_far((hit.t + hit.t_error - q.far_origin) / q.far_scale));
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

bool visit_leaf(void* pointer, unsigned surface, unsigned leaf_index, float& far) noexcept {
  Query& q = *static_cast<Query*>(pointer);
  const CompiledSurface& compiled = (*q.compiled)[surface];
  if (q.local_surface != surface) {
    q.local_surface = surface;
    q.local_valid = make_local_ray(q.ray->origin, q.ray->direction, compiled.frame, q.local);
    q.inverse_direction = 1.0 / q.local.direction;
  }
  if (!q.local_valid) return false;

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

  const TracedSurface& traced = (*q.surfaces)[surface];
  const Leaf& leaf = compiled.set.leaves[leaf_index];
  const Net& net = traced.surface.patches[static_cast<std::size_t>(leaf.patch)];
  const std::size_t ordinary = compiled.set.leaves.size() - compiled.radial.size();
  if (leaf_index < ordinary && traced.solver != Solver::clipping) {
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

}  // namespace

struct Tracer::Implementation {
  std::vector<TracedSurface> surfaces;
  std::vector<CompiledSurface> compiled;
  dvec3 center{0.0};
  double radius = 0.0;
  double unit = 1.0;  // power of two that brings the radius to [1, 2): what the hierarchy sees
  std::size_t leaf_count = 0;
  std::unique_ptr<EmbreeScene> embree;

  // Where the ray enters the scene's bounding sphere. False when it misses it.
  bool enter(const Ray& ray, Query& q, dvec3& origin, dvec3& direction, double& far) const {
    LocalRay global;
    if (!embree || !make_local_ray(ray.origin, ray.direction, center, global)) return false;
    const dvec3 base = global.base * unit;
    const double b2 = glm::dot(base, base), r = radius * unit * (1.0 + 1e-9);
    if (!(b2 <= r * r)) return false;
    const double half = std::sqrt((r * r - b2) / global.length2);
    const double start = (ray.t_min / global.scale - global.slide) * unit,
                 end = (ray.t_max / global.scale - global.slide) * unit;
    // A start on a surface may lie an error bound behind the first root that counts.
    const double near = std::max(start - 1e-9 * half, -half);
    if (!(near <= half) || !(end >= near)) return false;
    origin = base + near * global.direction;
    direction = global.direction;
    far = std::min(half, end) - near;
    q.far_origin = (global.slide + near / unit) * global.scale;
    q.far_scale = global.scale / unit;
    return true;
  }

  // What only a hit that is reported needs: the parameters of an analytic surface.
  void finish(Hit& hit) const {
    const CompiledSurface& surface = compiled[static_cast<std::size_t>(hit.surface)];
    if (!surface.ellipsoid) return;
    const dvec2 p = ellipsoid_parameters(*surface.ellipsoid, hit.point - surface.frame);
    hit.u = p.x, hit.v = p.y;
  }

  // And the normal of the nearest.
  void finish(Query& q) const {
    finish(q.best);
    const auto index = static_cast<std::size_t>(q.best.surface);
    if (compiled[index].ellipsoid) return;
    const Net& net = surfaces[index].surface.patches[static_cast<std::size_t>(q.best.patch)];
    q.best.normal = unit_normal(net, q.best.u, q.best.v, q.best_first);
  }

  Query make_query(const Ray& ray, Mode mode) const {
    Query q{};
    // A net on which a ray takes this many cells is degenerate; it must not stop the program.
    q.counts = &thread_counts();
    SearchCounts& search = q.counts->search;
    search.limit = search.cells + cells_per_query;
    q.surfaces = &surfaces, q.compiled = &compiled, q.ray = &ray, q.mode = mode;
    return q;
  }
};

namespace {

// Leaves beyond this many cost more memory than they save time; with more patches, each gets fewer.
constexpr double leaf_budget = 0x1p20;
// Beyond these, squares and products of coordinates leave the range of doubles.
constexpr double smallest_scene = 1e-60, largest_scene = 1e60;
constexpr int deepest = 11, shallowest = 2;
// Quarterings of a patch with a radial form: their boxes let enough rays by; more cost more than they save.
constexpr int radial_depth = 2;

CompiledSurface compile(const TracedSurface& traced, int max_depth) {
  const Surface& surface = traced.surface;
  CompiledSurface compiled;
  compiled.frame = surface.origin;
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
  return compiled;
}

}  // namespace

Tracer::Tracer(std::vector<TracedSurface> surfaces) : implementation_(std::make_unique<Implementation>()) {
  Implementation& self = *implementation_;
  self.surfaces = std::move(surfaces);
  const std::size_t count = self.surfaces.size();
  std::size_t patches = 1;
  for (const TracedSurface& traced : self.surfaces) patches += traced.surface.patches.size();
  const int depth = std::clamp(static_cast<int>(std::log2(leaf_budget / static_cast<double>(patches))),
                               shallowest, deepest);

  self.compiled.resize(count);
  std::vector<std::string> errors(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
    try {
      self.compiled[k] = compile(self.surfaces[k], depth);
    } catch (const std::runtime_error& error) {
      errors[k] = error.what();
    }
  });
  // The first in the scene's order, whichever thread met its own first.
  for (std::size_t k = 0; k < count; ++k)
    if (!errors[k].empty()) throw SurfaceError(k, errors[k]);

  Box world;
  for (std::size_t k = 0; k < count; ++k) {
    const dvec3& origin = self.surfaces[k].surface.origin;
    for (const Box& box : self.compiled[k].set.boxes) world.add(Box{box.low + origin, box.high + origin});
    self.leaf_count += self.compiled[k].set.boxes.size();
  }
  if (self.leaf_count == 0) return;
  self.center = world.center();
  std::vector<std::vector<Box>> boxes(count);
  for (std::size_t k = 0; k < count; ++k) {
    boxes[k] = self.compiled[k].set.boxes;
    const dvec3 shift = self.compiled[k].frame - self.center;
    for (Box& box : boxes[k]) {
      box.low += shift, box.high += shift;
      const dvec3 corner = glm::max(glm::abs(box.low), glm::abs(box.high));
      self.radius = std::max(self.radius, std::sqrt(3.0) * largest(corner));
    }
  }
  if (!(self.radius >= smallest_scene && self.radius <= largest_scene))
    throw std::runtime_error(fmt::format("the scene is too {}: its radius must be between {:g} and {:g}",
                                         self.radius < smallest_scene ? "small" : "large", smallest_scene,
                                         largest_scene));
  self.unit = std::ldexp(1.0, -std::ilogb(self.radius));
  for (std::vector<Box>& set : boxes)
    for (Box& box : set) box.low *= self.unit, box.high *= self.unit;
  self.embree = std::make_unique<EmbreeScene>(boxes, self.radius * self.unit, visit_leaf);
}

Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;

Hit Tracer::closest(const Ray& ray) const noexcept {
  Query q = implementation_->make_query(ray, Mode::closest);
  dvec3 origin, direction;
  double far;
  if (!implementation_->enter(ray, q, origin, direction, far)) return {};
  implementation_->embree->visit_all(origin, direction, far, &q);
  if (q.best) implementation_->finish(q);
  return q.best;
}

bool Tracer::occluded(const Ray& ray) const noexcept {
  Query q = implementation_->make_query(ray, Mode::any);
  dvec3 origin, direction;
  double far;
  if (!implementation_->enter(ray, q, origin, direction, far)) return false;
  return implementation_->embree->visit_any(origin, direction, far, &q);
}

std::vector<Hit> Tracer::all(const Ray& ray) const {
  std::vector<Hit> hits;
  std::vector<int> signs;
  Query q = implementation_->make_query(ray, Mode::all);
  q.hits = &hits, q.signs = &signs;
  dvec3 origin, direction;
  double far;
  if (!implementation_->enter(ray, q, origin, direction, far)) return {};
  implementation_->embree->visit_all(origin, direction, far, &q);

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
dvec3 Tracer::bounding_center() const { return implementation_->center; }
double Tracer::bounding_radius() const { return implementation_->radius; }

TracerStatistics Tracer::statistics() const {
  const Implementation& self = *implementation_;
  TracerStatistics s;
  s.surfaces = self.surfaces.size();
  s.leaves = self.leaf_count;
  for (std::size_t k = 0; k < self.surfaces.size(); ++k) {
    s.patches += self.surfaces[k].surface.patches.size();
    for (const Net& net : self.surfaces[k].surface.patches)
      s.bytes += sizeof(Net) + points_of(net).size() * sizeof(dvec4);
    s.bytes += self.compiled[k].set.leaves.size() * (sizeof(Leaf) + sizeof(Box));
  }
  if (self.embree) s.bytes += self.embree->bytes();
  return s;
}

}  // namespace rondure
