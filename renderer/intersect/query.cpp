#include "renderer/intersect/query.h"

#include <algorithm>

#include "renderer/bezier/quotient.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/hit_order.h"
#include "renderer/intersect/passed_walls.h"
#include "renderer/intersect/search_budget.h"
#include "renderer/intersect/slab.h"
#include "renderer/intersect/solve_leaf.h"
#include "renderer/intersect/surface_crossing.h"

namespace rondure {
namespace {

thread_local SearchBudget search_budget;  // of the thread's query

// Whether the crossing is a hit, in the query's ray (`local` in some frame), of `surface`; `t` receives its
// place. `normal()`: the one that the hit will have.
template <class Normal>
bool is_hit(const Query& q, unsigned surface, const LocalRay& local, const Crossing& c, const Normal& normal,
            double& t) {
  const dvec3& frame = q.surfaces[surface].origin;
  const bool accepted = accept(*q.ray, local, static_cast<int>(surface), frame, c, t);
  const RayStart& start = q.ray->start;
  if (start.surface < 0 || (start.surface == static_cast<int>(surface) && !start.passed)) return accepted;
  if (!is_at_start(*q.ray, local, frame, extent_of(q.surfaces[start.surface]), c)) return accepted;
  if (start.passed) {
    const PassedWalls::Answer answer =
        start.passed->ask(static_cast<int>(surface), normal(), local.direction);
    if (answer == PassedWalls::Answer::ahead) t = std::fmax(t, 0.0);
    if (answer != PassedWalls::Answer::unknown) return answer == PassedWalls::Answer::ahead;
  }
  if (start.surface == static_cast<int>(surface)) return accepted;
  const auto contact = [&] {
    const dvec3& o = q.ray->origin;
    return contact_of(q.surfaces, {surface, o, normal()},
                      {static_cast<unsigned>(start.surface), o, start.normal});
  };
  return accept_at_contact(*q.ray, local, c, accepted, contact, t);
}

// Whether a hit cannot be the closest any more.
bool is_beyond(const Query& q, double t) { return q.mode == Mode::closest && t > q.tied_until; }

// Where on the ray the search ends.
double end_of(const Query& q) { return std::min(q.ray->t_max, q.tied_until); }

void take_if_first(Query& q, const Hit& hit, float& far) {
  if (q.best) {
    const double reach = q.tied_until - q.best.t;
    // Of one surface two leaves may have found the same, but not its other wall.
    const bool other = hit.surface != q.best.surface || glm::dot(hit.normal, q.best.normal) < 0.0 ||
                       are_walls_of_one_t(q, hit, q.best);
    q.ties += other && std::fabs(hit.t - q.best.t) <= reach;
    if (!comes_first(q, hit, q.best)) return;
  }
  q.best = hit;
  q.tied_until = hit.t + 2.0 * tie_reach(q, hit);
  far = std::min(far, q.entry.round_far(q.tied_until));
}

// Takes one crossing into the query; `normal()` is the unit normal there. True when an occlusion query is
// answered.
template <class Normal>
bool take(Query& q, unsigned surface, int patch, dvec2 uv, const dvec3& point, const Normal& normal,
          const Crossing& c, float& far) {
  Hit hit;
  const dvec3& frame = q.surfaces[surface].origin;
  if (!is_hit(q, surface, q.local, c, normal, hit.t)) return false;
  if (q.mode == Mode::any) return true;
  if (is_beyond(q, hit.t)) return false;
  hit.t_error = c.s_error * q.local.scale;
  hit.surface = static_cast<int>(surface), hit.patch = patch, hit.u = uv.x, hit.v = uv.y;
  hit.point = frame + point, hit.normal = normal();
  if (q.mode == Mode::all) {
    q.hits->push_back(hit);
    q.signs->push_back(c.sign);
  } else {
    take_if_first(q, hit, far);
  }
  return false;
}

// Settling (settle.h) may carry a root from its leaf to another's, which has its own: all along a straight
// side that the ray runs in. The search for the closest hit need not come to the leaf that it is from: so
// that all searches have the same hits, those before `enter`, the step at which the leaf's box begins, are
// left out. Beside singular points rounding alone moves roots by 10^-6 of the surface's size, and nobody else
// may find them.
bool is_before_leaf(const Query& q, unsigned surface, double step, double enter) {
  constexpr double room = 0x1p-8;
  return step + room * size_of(q.surfaces[surface]) * std::sqrt(q.local.inverse_length2) < enter;
}

// As `take`, for a root on a leaf, `s` being the patch there. True when an occlusion query is answered.
bool take_root(Query& q, unsigned surface, const Leaf& leaf, const Net& net, const Root& root,
               const FirstOrder<dvec4>& s, double enter, float& far) {
  const double noise = q.surfaces[surface].compiled->patches[static_cast<std::size_t>(leaf.patch)].noise;
  const SurfaceCrossing at = cross_surface(leaf, net, noise, q.local, root, s);
  if (is_before_leaf(q, surface, at.crossing.s, enter)) return false;
  const auto normal = [&] { return at.normal; };
  return take(q, surface, leaf.patch, {root.u, root.v}, at.point, normal, at.crossing, far);
}

bool visit_ellipsoid(Query& q, unsigned surface, const Ellipsoid& ellipsoid, float& far) {
  const auto chord = meet_ellipsoid(ellipsoid, q.local);
  if (!chord) return false;
  const double error = ellipsoid_error(ellipsoid);
  for (const int side : {-1, 1}) {
    const EllipsoidHit hit = ellipsoid_hit(ellipsoid, *chord, side);
    const Crossing c = make_crossing(q.local, hit.point, hit.normal, error, ellipsoid.extent, false);
    const auto normal = [&] { return hit.normal; };
    if (take(q, surface, 0, dvec2(0.0), hit.point, normal, c, far)) return true;
    // Where this is the nearest, the other is not.
    if (q.mode == Mode::closest && q.best.surface == static_cast<int>(surface)) break;
  }
  return false;
}

// The two roots, entering first. The parameters are asked for only where a hit is the closest so far, or as
// close: which of those counts does not depend on the order.
bool visit_sphere(Query& q, unsigned surface, const PatchedSphere& sphere, float& far) {
  const dvec3& frame = q.surfaces[surface].origin;
  SphereRoots roots;
  LocalRay local = q.local;
  if (!meet_sphere(sphere, q.ray->origin, frame, local, roots)) return false;
  const std::vector<Net>& nets = *q.surfaces[surface].compiled->nets;
  const Ellipsoid& e = sphere.ellipsoid;
  const double error = sphere.error, grazing = std::sqrt(2.0 * error * e.extent);
  for (const int side : {-1, 1}) {
    const SpherePoint at = sphere_point(roots, side);
    const dvec3& n = at.n;
    // make_crossing's bound: error / cosine along the ray, and length times cosine is |n . d| / |normal|.
    const double stretch = sphere.inverse_radius > 0.0 ? e.uniform_radius : glm::length(n * e.inverse);
    Crossing c;
    c.s = roots.middle + side * roots.half;
    c.s_error = 2.0 * std::min(quotient(error * stretch * roots.inverse_length2, roots.half), grazing) +
                0x1p-52 * std::fabs(local.slide + c.s);
    c.extent = e.extent;
    const Reach reach{roots.direction, c.s_error};
    const int leaving = roots.half > 0.0 ? side : 0;
    c.sign = c.likely = sphere.outward < 0.0 ? -leaving : leaving;
    Hit hit;
    std::optional<PlaceOnSphere> place;
    // Which way the patch faces has to be known where the ray starts on the surface, or its path has met it.
    const RayStart& start = q.ray->start;
    if (sphere.outward == 0.0 && (start.surface == static_cast<int>(surface) || start.passed)) {
      place = place_on_sphere(sphere, nets, at, reach);
      if (!place) continue;
      c.sign = place->outward < 0.0 ? -leaving : leaving;
    }
    const auto normal = [&] {
      const dvec3 unit = sphere.inverse_radius > 0.0 ? n : glm::normalize(n * e.inverse);
      return (place ? place->outward : sphere.outward) < 0.0 ? -unit : unit;
    };
    if (!is_hit(q, surface, local, c, normal, hit.t)) continue;
    if (q.mode == Mode::any) {
      if (place || covers(sphere, nets, at, reach)) return true;
      continue;
    }
    if (is_beyond(q, hit.t)) return false;
    if (!place) place = place_on_sphere(sphere, nets, at, reach);
    if (!place) continue;
    hit.t_error = c.s_error * local.scale;
    hit.surface = static_cast<int>(surface), hit.patch = place->patch;
    hit.u = place->u, hit.v = place->v;
    hit.point = frame + (sphere.center + (sphere.inverse_radius > 0.0 ? e.uniform_radius * n : e.linear * n));
    hit.normal = normal();
    c.sign = place->outward < 0.0 ? -leaving : leaving;
    if (q.mode == Mode::all) {
      q.hits->push_back(hit);
      q.signs->push_back(c.sign);
      continue;
    }
    take_if_first(q, hit, far);
  }
  return false;
}

// A surface that is one sphere: by the short way where that tells.
bool visit_lone_sphere(Query& q, unsigned surface, float& far) {
  const PatchedSphere& sphere = *q.surfaces[surface].sphere;
  // What a hit needs of it, if there are so many that it is far away in memory.
  __builtin_prefetch(reinterpret_cast<const char*>(&sphere) + 64);
  __builtin_prefetch(reinterpret_cast<const char*>(&sphere) + 128);
  const SphereTarget target = target_at(sphere, q.surfaces[surface].origin, static_cast<int>(surface));
  if (q.mode == Mode::any) {
    const RayAnswer answer = sphere_occludes(target, *q.ray);
    if (answer != RayAnswer::unknown) return answer == RayAnswer::hit;
  }
  if (q.mode == Mode::closest) {
    Hit hit;
    const RayAnswer answer = closest_on_sphere(target, *q.ray, q.tied_until, hit);
    if (answer == RayAnswer::hit) take_if_first(q, hit, far);
    if (answer != RayAnswer::unknown) return false;
  }
  return visit_sphere(q, surface, sphere, far);
}

bool localise(Query& q, unsigned surface) {
  if (q.local_surface != surface && q.local_surface != Query::every_surface) {
    q.local_surface = surface;
    q.local_valid = set_base(q.ray->origin, q.surfaces[surface].origin, q.local);
    q.has_distances = false;
  }
  return q.local_valid;
}

// A surface that shares its leaves with others, in its own frame.
bool visit_instance(Query& q, unsigned surface, float& far) noexcept {
  if (!localise(q, surface)) return false;
  const Hierarchy& hierarchy = *q.surfaces[surface].compiled->hierarchy;
  const Entry outer = q.entry;
  if (!hierarchy.enter(q.local, q.ray->t_min, end_of(q), q.entry)) return false;
  q.instance = surface;
  bool settled = false;
  if (q.mode == Mode::any)
    settled = hierarchy.visit_any(q.local, q.entry, &q);
  else
    hierarchy.visit_all(q.local, q.entry, &q);
  q.entry = outer;
  if (q.best) far = std::min(far, outer.round_far(q.tied_until));
  return settled;
}

// What nets need beside the ray's base.
void make_planes(Query& q) {
  if (!q.has_normals) {
    set_normals(q.local);
    q.has_normals = true;
  }
  set_distances(q.local);
  q.has_distances = true;
  if (q.counts) return;
  q.counts = &thread_counts();
  search_budget.start();
}

// `enter`: the step at which the leaf's box begins, where that is known.
bool visit_net(Query& q, unsigned surface, unsigned leaf_index, double enter, float& far) {
  const CompiledSurface& compiled = *q.surfaces[surface].compiled;
  if (!q.has_distances) make_planes(q);
  const Leaf& leaf = compiled.set.leaves[leaf_index];
  const Net& net = (*compiled.nets)[static_cast<std::size_t>(leaf.patch)];
  const std::size_t ordinary = compiled.set.leaves.size() - compiled.radial.size();
  if (leaf_index < ordinary && compiled.solver != Solver::clipping) {
    NewtonRoot found;
    const NewtonPatch& patch = compiled.patches[static_cast<std::size_t>(leaf.patch)];
    const NewtonVerdict verdict = solve_by_newton(leaf, net, patch, q.local, found, *q.counts);
    if (verdict == NewtonVerdict::root)
      return take_root(q, surface, leaf, net, found.root, found.surface, -INFINITY, far);
    if (verdict == NewtonVerdict::none) return false;
  }
  // The hierarchy's boxes are padded for the whole scene's size. On a small object in a large scene that lets
  // every ray by; in double the leaf's own box does not. (A cluster's are in double.)
  if (compiled.cluster.empty()) {
    const Span span = span_in_box(q.local, inverse_of(q.local.direction), compiled.set.boxes[leaf_index]);
    if (!(span.enter <= span.leave)) return false;
    enter = span.enter;
  }
  static thread_local std::vector<Root> roots;  // one visit's; kept so that nothing is allocated
  roots.clear();
  if (leaf_index >= ordinary)
    solve_radial(compiled.radial[leaf_index - ordinary], leaf, net, q.local, roots);
  else
    search_budget.spend(surface, q.counts->search,
                        [&] { search_leaf(leaf, net, q.local, roots, *q.counts); });
  for (const Root& root : roots)
    if (take_root(q, surface, leaf, net, root, net_first(net, root.u, root.v), enter, far)) return true;
  return false;
}

// From memory, in good time.
template <class T>
void fetch(std::span<const T> from) {
  constexpr std::size_t line = 64;
  const auto bytes = std::as_bytes(from);
  for (std::size_t at = 0; at < bytes.size(); at += line) __builtin_prefetch(bytes.data() + at);
}

// What the leaves that a ray may meet have to be met with. Waiting for one after the other would take longer
// than all else.
void fetch_leaves(const CompiledSurface& compiled, std::span<const LeafCluster::Met> met) {
  if (met.empty()) return;
  for (const LeafCluster::Met& m : met) fetch(std::span<const Leaf>(&compiled.set.leaves[m.leaf], 1));
  fetch(std::span<const NewtonPatch>(compiled.patches));
  fetch(std::span<const Net>(*compiled.nets));
  const auto patch = static_cast<std::size_t>(compiled.set.leaves[met[0].leaf].patch);
  fetch(std::span<const dvec4>(points_of((*compiled.nets)[patch])));
}

// A surface whose leaves are a cluster.
bool visit_cluster(Query& q, unsigned surface, float& far) {
  fetch(q.surfaces[surface].boxes);
  const CompiledSurface& compiled = *q.surfaces[surface].compiled;
  fetch(std::span<const CompiledSurface>(&compiled, 1));
  if (!localise(q, surface)) return false;
  const auto step_at = [&](double t) { return t * q.local.inverse_scale - q.local.slide; };
  LeafCluster::AllMet met;
  const std::size_t count = compiled.cluster.meet(q.local, step_at(q.ray->t_min), step_at(end_of(q)), met);
  constexpr std::size_t few = 3;  // are soon needed
  fetch_leaves(compiled, std::span(met).first(std::min(count, few)));
  double last = INFINITY;
  for (std::size_t k = 0; k < count && met[k].enter <= last; ++k) {
    const double before = q.best.t;
    if (visit_net(q, surface, met[k].leaf, met[k].enter, far)) return true;
    if (q.mode == Mode::closest && q.best && q.best.t != before)
      last = compiled.cluster.last_step(q.local, step_at(end_of(q)));
  }
  return false;
}

}  // namespace

bool visit_leaf(Query& q, unsigned surface, unsigned leaf, float& far) noexcept {
  const CompiledSurface& compiled = *q.surfaces[surface].compiled;
  if (const PatchedSphere* sphere = compiled.analytic.get()) {
    if (sphere->radius > 0.0) return visit_sphere(q, surface, *sphere, far);
    return localise(q, surface) && visit_ellipsoid(q, surface, sphere->ellipsoid, far);
  }
  if (const std::size_t leaves = compiled.set.leaves.size(); leaf >= leaves)
    return visit_sphere(q, surface, compiled.spheres[leaf - leaves], far);
  if (!localise(q, surface)) return false;
  return visit_net(q, surface, leaf, -INFINITY, far);
}

bool visit_shared_leaf(void* pointer, unsigned, unsigned leaf, float& far) noexcept {
  Query& q = *static_cast<Query*>(pointer);
  return visit_leaf(q, q.instance, leaf, far);
}

bool visit_by_name(void* pointer, unsigned surface, unsigned leaf, float& far) noexcept {
  Query& q = *static_cast<Query*>(pointer);
  if (leaf == LeafName::sphere) return visit_lone_sphere(q, surface, far);
  if (leaf == LeafName::cluster) return visit_cluster(q, surface, far);
  return leaf == LeafName::whole ? visit_instance(q, surface, far) : visit_leaf(q, surface, leaf, far);
}

void finish(const PlacedSurface& surface, Hit& hit) {
  const PatchedSphere* const analytic = surface.compiled->analytic.get();
  if (!analytic) return;
  const dvec2 p = ellipsoid_parameters(analytic->ellipsoid, hit.point - surface.origin);
  hit.u = p.x, hit.v = p.y;
}

}  // namespace rondure
