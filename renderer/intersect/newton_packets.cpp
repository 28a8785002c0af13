#include "renderer/intersect/newton_packets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "renderer/bezier/dispatch.h"
#include "renderer/bezier/regular_normal.h"
#include "renderer/intersect/settle.h"

// What remains: SSE4, AVX2 and AVX-512, and plain code for all else.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/intersect/newton_packets.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rondure {
namespace HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

// One lane: all is handed back.
void closest_wide(const PacketTarget&, const Ray*, std::size_t count, Hit*, PreparedRay*,
                  PacketAnswer* answers) {
  std::fill(answers, answers + count, PacketAnswer::unknown);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

#define INLINE_FOR_THIS_SET HWY_ATTR HWY_INLINE
#include "renderer/intersect/jets-inl.h"
#include "renderer/intersect/lanes-inl.h"
#include "renderer/intersect/newton_arithmetic-inl.h"
#include "renderer/intersect/newton_lanes-inl.h"
#include "renderer/intersect/packet_rays-inl.h"
#include "renderer/intersect/packet_slabs-inl.h"
#include "renderer/intersect/packet_take-inl.h"
#undef INLINE_FOR_THIS_SET

// A leaf as seen by as many rays as there are lanes.
struct View {
  FramedRay<Lanes> ray;
  Outlook<Lanes> outlook;
};

HWY_INLINE View view_of(const Packet& q, const LeafFrame& frame, std::size_t g) {
  const V o[3] = {part(q.base[0], g), part(q.base[1], g), part(q.base[2], g)},
          along[3] = {part(q.direction[0], g), part(q.direction[1], g), part(q.direction[2], g)};
  View view;
  view.ray = framed<Lanes>(frame, o, along), view.outlook = outlook_of<Lanes>(frame, view.ray);
  return view;
}

HWY_INLINE Pair<Lanes> merged(M in_second, const Pair<Lanes>& b, const Pair<Lanes>& a) {
  return {hn::IfThenElse(in_second, b.x, a.x), hn::IfThenElse(in_second, b.y, a.y)};
}
// `b` in some lanes, `a` in the others.
HWY_INLINE View merged(M in_second, const View& b, const View& a) {
  const auto &p = a.outlook, &q = b.outlook;
  return {{merged(in_second, b.ray.slope, a.ray.slope), merged(in_second, b.ray.foot, a.ray.foot)},
          {merged(in_second, q.middle, p.middle), merged(in_second, q.room, p.room),
           hn::IfThenElse(in_second, q.straight, p.straight), hn::IfThenElse(in_second, q.oblique, p.oblique),
           hn::IfThenElse(in_second, q.grazing, p.grazing)}};
}

// Of the lanes that are `active`, those whose rays may meet the leaf, and once if they do; others may be
// handed back. As on_leaf (newton_kernel.h).
HWY_INLINE M screen(Packet& q, const Leaf& leaf, const View& view, bool rectangle, M active,
                    const Limits& far, std::size_t g) {
  const D d;
  const auto& [ray, outlook] = view;
  const Pair<Lanes>&middle = outlook.middle, &room = outlook.room;
  const V center = hn::Set(d, rectangle ? 0.5 : 1.0 / 3.0), zero = hn::Zero(d), one = hn::Set(d, 1.0);
  M misses;
  if (rectangle) {
    misses = hn::Or(hn::Gt(hn::Abs(middle.x), center + room.x), hn::Gt(hn::Abs(middle.y), center + room.y));
  } else {
    const Pair<Lanes> p{middle.x + center, middle.y + center};
    misses = hn::Or(hn::Or(hn::Lt(p.x, zero - room.x), hn::Lt(p.y, zero - room.y)),
                    hn::Gt(p.x + p.y, one + room.x + room.y));
  }
  active = hn::AndNot(misses, active);
  if (hn::AllFalse(d, active)) return active;
  const M proven = hn::And(hn::Lt(outlook.straight, hn::Set(d, newton_limits::straight)),
                           hn::Lt(outlook.grazing, hn::Set(d, newton_limits::uniqueness)));
  const M grazes = hn::AndNot(proven, active);
  if (!hn::AllFalse(d, grazes)) {
    const M passes = hn::Gt(passing_of<Lanes>(leaf.frame, ray), zero);
    hand_back(q, hn::AndNot(passes, grazes), far, slots_at(g));
  }
  return hn::And(active, proven);
}

// The rest of on_leaf.
template <class Patch>
HWY_ATTR void solve(Packet& q, unsigned surface, const Leaf& leaf, const NewtonPatch& of, const View& view,
                    M active, const Limits& far, const Slots& at) {
  constexpr bool rectangle = Patch::rectangle;
  const D d;
  const Patch patch{of};
  const FramedRay<Lanes>& local = view.ray;
  const Outlook<Lanes>& outlook = view.outlook;
  const Pair<Lanes>&middle = outlook.middle, &room = outlook.room;
  constexpr double center_place = rectangle ? 0.5 : 1.0 / 3.0;
  const V center = hn::Set(d, center_place), zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const V margin = hn::Set(d, (leaf_enlargement - 1.0) * center_place), tail = tail_of<Lanes>(outlook);
  LanePlanes planes;
  for (int p = 0; p < 2; ++p)
    for (int k = 0; k < 4; ++k) planes.plane[p][k] = part(q.plane[p][k], at);
  const Pair<Lanes> start = start_of<Lanes>(leaf.frame, local);
  Pair<Lanes> p{center + start.x, center + start.y};
  // Leaves out the lanes that have left the enlarged leaf: without a root, or handed back.
  const auto leave = [&]() HWY_ATTR {
    const V outside = outside_leaf<rectangle, Lanes>(p);
    const M gone = hn::AndNot(hn::Lt(outside, margin), active);
    if (hn::AllFalse(d, gone)) return;
    const V reach = hn::Max(room.x + hn::Abs(start.x - middle.x), room.y + hn::Abs(start.y - middle.y));
    const M none = hn::And(hn::Lt(outlook.straight + outlook.oblique, hn::Set(d, newton_limits::contraction)),
                           hn::Gt(outside, reach));
    hand_back(q, hn::AndNot(none, gone), far, at);
    active = hn::AndNot(gone, active);
  };
  leave();
  PointBend<Lanes> bend;
  M bent = hn::Lt(one, zero);
  if (patch.bends()) {
    bend = patch.second(place_in_patch<rectangle, Lanes>(leaf, p));
    const Pair<Lanes> step = first_step<rectangle, Lanes>(leaf, bend, planes);
    p = {p.x - step.x, p.y - step.y};
    bent = hn::Lt(size_of<Lanes>(step), hn::Set(d, newton_limits::longest_bent));
    leave();
  }
  // More steps than this are rare enough to be left to the ray alone.
  constexpr int few_steps = 4;
  for (int k = 0; k < few_steps && !hn::AllFalse(d, active); ++k) {
    const PointJet<Lanes> s = patch.first(place_in_patch<rectangle, Lanes>(leaf, p));
    const Slopes<Lanes> slopes = slopes_of<rectangle, Lanes>(leaf, planes(s.du), planes(s.dv));
    const Pair<Lanes> step = step_for<Lanes>(slopes, planes(s.value));
    p = {p.x - step.x, p.y - step.y};
    const V length = size_of<Lanes>(step), outside = outside_leaf<rectangle, Lanes>(p);
    M done = hn::And(active, hn::Lt(length * length * tail, hn::Set(d, 0x1p-53)));
    active = hn::AndNot(done, active);
    if (k + 1 < few_steps) leave();
    if (hn::AllFalse(d, done)) continue;
    // As residual_bound.
    const V error = hn::Set(d, residual_roundoffs * unit_roundoff) *
                    (hn::Set(d, leaf.scale.position) + part(q.reach, at) * hn::Set(d, leaf.scale.weight));
    const V rows =
        hn::Max(hn::Abs(slopes.b.x) + hn::Abs(slopes.b.y), hn::Abs(slopes.a.x) + hn::Abs(slopes.a.y));
    const V beside =
        hn::Set(d, 2.0) * error * rows * hn::Abs(slopes.inverse) + hn::Set(d, 4.0 * unit_roundoff);
    done = hn::AndNot(hn::And(hn::Gt(outside, zero), hn::Gt(outside, beside)), done);
    const Pair<Lanes> root = place_in_patch<rectangle, Lanes>(leaf, p);
    // What is beside its patch has to be settled.
    const M inside = hn::Le(outside_leaf<rectangle, Lanes>(root), zero);
    hand_back(q, hn::AndNot(inside, done), far, at);
    done = hn::And(done, inside);
    const M near = hn::And(bent, hn::Lt(length, hn::Set(d, newton_limits::longest_moved)));
    PointJet<Lanes> there = s;
    if (patch.bends()) there = moved<Lanes>(s, bend, difference_in_patch<rectangle, Lanes>(leaf, step));
    if (!hn::AllFalse(d, hn::AndNot(near, done))) {
      const PointJet<Lanes> fresh = patch.first(root);
      const auto choose = [&](Lanes::Point& a, const Lanes::Point& b) HWY_ATTR {
        a = {hn::IfThenElse(near, a.x, b.x), hn::IfThenElse(near, a.y, b.y), hn::IfThenElse(near, a.z, b.z),
             hn::IfThenElse(near, a.w, b.w)};
      };
      choose(there.value, fresh.value), choose(there.du, fresh.du), choose(there.dv, fresh.dv);
    }
    take(q, surface, leaf, of, done, root, there, far, at);
  }
  hand_back(q, active, far, at);
}

using Solve = void (*)(Packet&, unsigned, const Leaf&, const NewtonPatch&, const View&, M, const Limits&,
                       const Slots&);

Solve solve_of(const NewtonPatch& patch) {
  if (!patch.is_rectangle()) return patch.m == 4 ? solve<LaneTriangle<4> > : solve<LaneTriangle<dynamic> >;
  switch (100 * patch.m + patch.n) {
    case 204:
      return solve<LaneRectangle<2, 4> >;
    case 303:
      return solve<LaneRectangle<3, 3> >;
    case 404:
      return solve<LaneRectangle<4, 4> >;
    default:
      return solve<LaneRectangle<dynamic, dynamic> >;
  }
}

// `valid` and `far`: as the traversal gives them, of `count` rays.
void visit_leaf(Packet& q, unsigned surface, unsigned index, const Limits& far, std::size_t count,
                const int* valid) {
  const D d;
  const std::size_t first = far.first;
  const CompiledSurface& compiled = *q.target.surfaces[surface].compiled;
  const Leaf& leaf = compiled.set.leaves[index];
  const NewtonPatch& patch = compiled.patches[static_cast<std::size_t>(leaf.patch)];
  const Solve solve_lanes = solve_of(patch);
  const hn::Rebind<std::int32_t, D> di;
  // Rays of two groups are met together where they are in different lanes.
  Slots at{};
  View waiting_view;
  M waiting = hn::Lt(hn::Zero(d), hn::Zero(d));
  for (std::size_t g = first; g < first + count; g += lane_count) {
    const V asked = hn::PromoteTo(d, hn::LoadU(di, valid + (g - first)));
    M active = hn::And(hn::Lt(asked, hn::Zero(d)), is_open(q, g));
    // As far from the surface's frame as from the scene's centre, but for the scene's own size.
    const M near = hn::Lt(hn::Abs(part(q.slide, g)), hn::Set(d, farthest_base));
    hand_back(q, hn::AndNot(near, active), far, slots_at(g));
    active = hn::And(active, near);
    if (hn::AllFalse(d, active)) continue;
    const View view = view_of(q, leaf.frame, g);
    const M left = screen(q, leaf, view, patch.is_rectangle(), active, far, g);
    if (hn::AllFalse(d, left)) continue;
    if (hn::AllFalse(d, waiting)) {
      at = slots_at(g), waiting = left, waiting_view = view;
    } else if (at.are_one() && hn::AllFalse(d, hn::And(waiting, left))) {
      at.second = g, at.in_second = left, waiting = hn::Or(waiting, left);
      waiting_view = merged(left, view, waiting_view);
    } else {
      solve_lanes(q, surface, leaf, patch, waiting_view, waiting, far, at);
      at = slots_at(g), waiting = left, waiting_view = view;
    }
  }
  if (!hn::AllFalse(d, waiting)) solve_lanes(q, surface, leaf, patch, waiting_view, waiting, far, at);
}

void visit_wide(void* query, unsigned surface, unsigned index, std::size_t first, std::size_t count,
                const int* valid, float* limits) noexcept {
  const D d;
  const Limits far{limits, first};
  Packet& q = *static_cast<Packet*>(query);
  if (!q.target.one_frame && q.local_surface != surface) {
    q.local_surface = surface;
    for (std::size_t g = 0; g < width; g += lane_count) set_base_of(q, q.target.surfaces[surface].origin, g);
  }
  if (index != LeafName::cluster) {
    visit_leaf(q, surface, index, far, count, valid);
    return;
  }
  const LeafCluster& cluster = q.target.surfaces[surface].compiled->cluster;
  const hn::Rebind<std::int32_t, D> di;
  Corridor corridor;
  for (std::size_t g = first; g < first + count; g += lane_count) {
    const V asked = hn::PromoteTo(d, hn::LoadU(di, valid + (g - first)));
    corridor.add(q, cluster, hn::And(hn::Lt(asked, hn::Zero(d)), is_open(q, g)), g);
  }
  cluster.visit([&](const Box& box) HWY_ATTR { return corridor.meets(box); },
                [&](unsigned leaf) HWY_ATTR { visit_leaf(q, surface, leaf, far, count, valid); });
}

void closest_wide(const PacketTarget& target, const Ray* rays, std::size_t count, Hit* hits,
                  PreparedRay* prepared, PacketAnswer* answers) {
  const D d;
  Packet q(target);
  EmbreeScene::Packet out;
  const V infinity = hn::Set(d, INFINITY), zero = hn::Zero(d);
  Extent extent;
  for (int k = 0; k < 6; ++k) extent.low[k] = infinity, extent.high[k] = zero - infinity;
  M entering[width / lane_count];
  bool any = false;
  if (target.hierarchy->packet_width() < lane_count) {
    std::fill(answers, answers + count, PacketAnswer::unknown);
    return;
  }
  for (std::size_t g = 0; g < width; g += lane_count) {
    const double* in[lane_count];
    alignas(64) double ours[lane_count];
    for (std::size_t k = 0; k < lane_count; ++k) {
      const Ray& ray = rays[std::min(g + k, count - 1)];
      in[k] = &ray.origin.x;
      ours[k] = g + k < count && ray.start.surface < 0 ? 1.0 : 0.0;
    }
    M& enters = entering[g / lane_count];
    enters = enter(q, in, hn::Gt(hn::Load(d, ours), zero), out, extent, g);
    any = any || !hn::AllFalse(d, enters);
    set_part(q.t, g, infinity);
  }
  if (any) {
    double apart = 0.0;
    for (int k = 0; k < 6; ++k)
      apart = std::max(apart, hn::GetLane(hn::MaxOfLanes(d, extent.high[k])) -
                                  hn::GetLane(hn::MinOfLanes(d, extent.low[k])));
    if (apart > target.spread)
      for (std::size_t g = 0; g < width; g += lane_count)
        set_part(q.open, slots_at(g), entering[g / lane_count], zero);
    else
      target.hierarchy->visit_packet(out, visit_wide, &q);
  }
  for (std::size_t g = 0; g < count; g += lane_count)
    unload(q, hn::Lt(part(q.t, g), infinity), count, hits, answers, g);
  for (std::size_t k = 0; k < count; ++k)
    if (answers[k] == PacketAnswer::prepared) prepare(q, k, prepared[k]);
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace rondure
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rondure {

HWY_EXPORT(closest_wide);

bool can_meet_packets(const PlacedSurface& surface) {
  const CompiledSurface& compiled = *surface.compiled;
  return compiled.solver == Solver::newton && !surface.sphere && !compiled.analytic && !compiled.hierarchy &&
         compiled.spheres.empty() && compiled.radial.empty();
}

void closest_in_packet(const PacketTarget& target, const Ray* rays, std::size_t count, Hit* hits,
                       PreparedRay* prepared, PacketAnswer* answers) noexcept {
  HWY_DYNAMIC_DISPATCH(closest_wide)(target, rays, count, hits, prepared, answers);
}

}  // namespace rondure
#endif
