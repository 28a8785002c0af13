#include "renderer/intersect/sphere_packets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

// What remains: SSE4, AVX2 and AVX-512, and plain code for all else.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/intersect/sphere_packets.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rondure {
namespace HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

// One lane: all is handed back.
void closest_wide(const SphereTarget&, const Ray*, std::size_t count, Hit*, unsigned char* done) {
  std::fill(done, done + count, static_cast<unsigned char>(0));
}

#else

namespace hn = hwy::HWY_NAMESPACE;

#include "renderer/intersect/lanes-inl.h"
#include "renderer/intersect/sphere_kernel-inl.h"
#include "renderer/intersect/sphere_meet-inl.h"

HWY_INLINE unsigned bits_of(M mask) {
  std::uint8_t bytes[8];  // of which it may write all
  hn::StoreMaskBits(D(), mask, bytes);
  return bytes[0];
}

// What the cells of a group's hits say.
struct Held {
  const SphereCell* cells[lane_count];
  alignas(64) std::int64_t owners[lane_count];  // 0 where none is known
  M owned, several;                             // a patch is known there; another may be, too
};

HWY_INLINE void fetch(const SpherePatches& all, const Group& g, Held& held) {
  for (std::size_t k = 0; k < lane_count; ++k) {
    held.cells[k] = &all.cells[static_cast<std::size_t>(g.cell[k])];
    const char* const bytes = reinterpret_cast<const char*>(held.cells[k]);
    __builtin_prefetch(bytes), __builtin_prefetch(bytes + 64);
  }
}

static_assert(offsetof(SphereCell, start) == 0 && offsetof(SphereCell, owner) == 80 &&
              offsetof(SphereCell, next) == 88 && sizeof(SphereCell) == 96);

// As SphereCell::start_at: pairs of floats, u and v, in the place of doubles. And what else the cells say.
HWY_INLINE void start(const Group& g, Held& held, V& u, V& v) {
  const D d;
  const hn::Repartition<float, D> pairs;
  const hn::Rebind<float, D> df;
  const hn::RebindToSigned<D> di;
  const hn::RebindToUnsigned<D> du;
  const hn::Rebind<std::uint32_t, D> du32;
  const double* rows[lane_count];
  V numbers[12];
  for (std::size_t k = 0; k < lane_count; ++k)
    rows[k] = reinterpret_cast<const double*>(held.cells[k]->start);
  columns_of<8>(d, rows, numbers);
  for (std::size_t k = 0; k < lane_count; ++k) rows[k] += 8;
  columns_of<4>(d, rows, numbers + 8);
  // Whole numbers of 32 bits, of which these come first in their places.
  const auto owner = hn::ShiftLeft<32>(hn::BitCast(di, numbers[10])),
             next = hn::ShiftLeft<32>(hn::BitCast(di, numbers[11])), none = hn::Zero(di);
  held.owned = hn::RebindMask(d, hn::Not(hn::Lt(owner, none)));
  held.several = hn::RebindMask(d, hn::Not(hn::Lt(next, none)));
  hn::Store(hn::ShiftRight<32>(hn::Max(owner, none)), di, held.owners);
  const auto f = [&](int k) HWY_ATTR { return hn::BitCast(pairs, numbers[k]); };
  const auto twice = [&](V x) HWY_ATTR {
    const auto bits = hn::PromoteTo(du, hn::BitCast(du32, hn::DemoteTo(df, x)));
    return hn::BitCast(pairs, hn::Or(bits, hn::ShiftLeft<32>(bits)));
  };
  const auto a = twice(g.a), b = twice(g.b), aa = a * a, ab = a * b, bb = b * b;
  const auto both = (((f(0) + f(1) * a) + f(2) * b) + f(4) * ab) +
                    ((f(3) + (f(6) * a + f(7) * b)) * aa + (f(5) + (f(8) * a + f(9) * b)) * bb);
  const auto bits = hn::BitCast(du, both);
  u = hn::PromoteTo(d, hn::BitCast(df, hn::TruncateTo(du32, bits)));
  v = hn::PromoteTo(d, hn::BitCast(df, hn::TruncateTo(du32, hn::ShiftRight<32>(bits))));
}

// As in_domain, of patches of either kind.
HWY_INLINE M inside(const dvec2& middle, bool triangle, V u, V v) {
  const D d;
  const V p = u + hn::Set(d, middle.x), q = v + hn::Set(d, middle.y), zero = hn::Zero(d);
  const V farthest = triangle ? p + q : hn::Max(p, q);
  return hn::And(hn::And(hn::Ge(p, zero), hn::Ge(q, zero)), hn::Le(farthest, hn::Set(d, 1.0)));
}

// As cell_around. Lanes that it cannot tell of are not in what is returned.
HWY_INLINE M start_around(const SpherePatches& all, const Group& g, Held& held, V& u, V& v) {
  const D d;
  const bool triangle = all.patches[0].triangle;
  for (;;) {
    start(g, held, u, v);
    if (!all.one_kind) return hn::Not(held.several);
    const M here = inside(all.inverses[0].middle, triangle, u, v);
    unsigned astray = bits_of(hn::And(held.several, hn::AndNot(here, g.hit)));
    if (astray == 0) return g.hit;
    for (; astray != 0; astray &= astray - 1) {
      const SphereCell*& cell = held.cells[std::countr_zero(astray)];
      cell = &all.cells[static_cast<std::size_t>(cell->next)];
    }
  }
}

// The points in their patches' frames; z less 1.
HWY_INLINE void turn_to_patches(const SpherePatches& all, const Held& held, const V* n, V& x, V& y, V& w) {
  const D d;
  const Lift<D> lift;
  V m[3][4];
  if (lane_count == SpherePatches::few && all.patches.size() <= SpherePatches::few) {
    // All in a register, each lane picking its own.
    const auto which = hn::SetTableIndices(d, held.owners);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        m[i][k] = hn::TableLookupLanes(hn::Load(d, all.axes_of_few[3 * i + k].data()), which);
  } else {
    const double* rows[lane_count];
    for (std::size_t k = 0; k < lane_count; ++k)
      rows[k] = &all.patches[static_cast<std::size_t>(held.owners[k])].axes[0].x;
    columns_of<8>(d, rows, &m[0][0]);
    for (std::size_t k = 0; k < lane_count; ++k) rows[k] += 8;
    columns_of<4>(d, rows, m[2]);
  }
  x = (m[0][0] * n[0] + m[1][0] * n[1]) + m[2][0] * n[2];
  y = (m[0][1] * n[0] + m[1][1] * n[1]) + m[2][1] * n[2];
  w = lift(1.0) - ((m[0][2] * n[0] + m[1][2] * n[1]) + m[2][2] * n[2]);
}

// Lanes that have not converged are not in what is returned.
template <int K>
HWY_INLINE M parameters_at(const PatchInverse& inverse, V x, V y, V w, V& u, V& v) {
  const D d;
  const auto good = [&](const Stride<V>& s) HWY_ATTR {
    return hn::And(hn::And(hn::Le(s.first2 * s.second2, hn::Set(d, last_parts2)),
                           hn::Le(s.first2, hn::Set(d, last_step2))),
                   hn::Le(s.steep2, hn::Set(d, inverse.steepest2)));
  };
  Residual<K, V> c;
  residual_of<K>(inverse.coefficients.data(), x, y, w, c, Lift<D>());
  M done = good(step_towards_zero<K>(c, u, v, Lift<D>()));
  for (int k = 1; k < inverse_steps && !hn::AllTrue(d, done); ++k) {
    V more_u = u, more_v = v;
    const M now = good(step_towards_zero<K>(c, more_u, more_v, Lift<D>()));
    u = hn::IfThenElse(done, u, more_u), v = hn::IfThenElse(done, v, more_v);
    done = hn::Or(done, now);
  }
  return done;
}

// The parameters of the hits. Lanes whose patch does not hold them, or has not told in a few steps, are no
// longer known.
HWY_INLINE void place(const SpherePatches& patches, Held& held, Group& g, V& out_u, V& out_v) {
  const D d;
  const Lift<D> lift;
  const V zero = lift(0.0), one = lift(1.0);
  V u, v, x, y, w;
  const M clear = start_around(patches, g, held, u, v);
  turn_to_patches(patches, held, g.point, x, y, w);
  M pending = hn::And(hn::And(g.hit, clear), held.owned), placed = hn::Lt(one, zero);
  out_u = out_v = zero;
  // Patches are mostly congruent; where not, one inverse after the other.
  const bool congruent = patches.inverses.size() == 1;
  while (!hn::AllFalse(d, pending)) {
    const auto inverse_of = [&](std::size_t k) {
      return patches.patches[static_cast<std::size_t>(held.owners[k])].inverse;
    };
    const std::int32_t which =
        congruent ? 0 : inverse_of(static_cast<std::size_t>(hn::FindFirstTrue(d, pending)));
    M these = pending;
    if (!congruent) {
      alignas(64) double mine[lane_count];
      for (std::size_t k = 0; k < lane_count; ++k) mine[k] = inverse_of(k) == which ? 1.0 : 0.0;
      these = hn::And(these, hn::Eq(hn::Load(d, mine), one));
    }
    pending = hn::AndNot(these, pending);
    const PatchInverse& inverse = patches.inverses[static_cast<std::size_t>(which)];
    V this_u = u, this_v = v;
    M good = inverse.degree == 2 ? parameters_at<2>(inverse, x, y, w, this_u, this_v)
                                 : parameters_at<4>(inverse, x, y, w, this_u, this_v);
    good = hn::And(hn::And(good, these), inside(inverse.middle, inverse.middle.x != 0.5, this_u, this_v));
    this_u = this_u + lift(inverse.middle.x), this_v = this_v + lift(inverse.middle.y);
    out_u = hn::IfThenElse(these, this_u, out_u), out_v = hn::IfThenElse(these, this_v, out_v);
    placed = hn::Or(placed, good);
  }
  g.known = hn::And(g.known, hn::Or(hn::Not(g.hit), placed));
}

static_assert(offsetof(Hit, surface) == 2 * sizeof(double) &&
              offsetof(Hit, patch) == offsetof(Hit, surface) + 4 && offsetof(Hit, u) == 3 * sizeof(double) &&
              offsetof(Hit, v) == 4 * sizeof(double) && offsetof(Hit, point) == 5 * sizeof(double) &&
              offsetof(Hit, normal) == 8 * sizeof(double) && sizeof(Hit) == 11 * sizeof(double));

// Writes what is known.
HWY_INLINE void unload(const SphereTarget& target, const Held& held, const Group& g, V u, V v,
                       const Ray* rays, std::size_t count, Hit* hits, unsigned char* done) {
  const D d;
  const Lift<D> lift;
  const hn::RebindToSigned<D> di;
  const V zero = lift(0.0);
  const PatchedSphere& sphere = *target.sphere;
  const unsigned known = bits_of(g.known);
  double* to[lane_count];
  for (std::size_t k = 0; k < lane_count; ++k) {
    const bool mine = k < count && (known >> k & 1u) != 0 && rays[k].start.surface != target.surface;
    to[k] = mine ? &hits[k].t : nullptr;
    if (k < count) done[k] = mine ? 1 : 0;
  }
  V side = lift(sphere.outward);
  if (sphere.outward == 0.0) {
    alignas(64) double outward[lane_count];
    for (std::size_t k = 0; k < lane_count; ++k)
      outward[k] = sphere.patches->patches[static_cast<std::size_t>(held.owners[k])].outward;
    side = hn::Load(d, outward);
  }
  // Surface and patch share a number's place.
  auto patch = hn::Load(di, held.owners) + hn::Set(di, std::int64_t{sphere.first});
  if (sphere.named) {
    alignas(64) std::int64_t names[lane_count];
    for (std::size_t k = 0; k < lane_count; ++k)
      names[k] = sphere.names[static_cast<std::size_t>(held.owners[k])];
    patch = hn::Load(di, names);
  }
  const V name = hn::BitCast(d, hn::Or(hn::ShiftLeft<32>(patch), hn::Set(di, std::int64_t{target.surface}))),
          nobody = hn::BitCast(d, hn::Set(di, std::int64_t{-1}));
  const dvec3 &frame = target.frame, &center = sphere.center;
  const V radius = lift(target.radius);
  V numbers[11] = {g.t, g.t_error, name, u, v};
  for (int k = 0; k < 3; ++k) {
    numbers[5 + k] = lift(frame[k]) + (lift(center[k]) + radius * g.point[k]);
    numbers[8 + k] = side * g.point[k];
  }
  const V none[3] = {lift(INFINITY), zero, nobody};
  for (int k = 0; k < 11; ++k) numbers[k] = hn::IfThenElse(g.hit, numbers[k], k < 3 ? none[k] : zero);
  rows_of<8>(d, numbers, to);
  for (double*& row : to)
    if (row) row += 7;
  rows_of<4>(d, numbers + 7, to);
}

HWY_INLINE void unload_misses(const SphereTarget& target, const Group& g, const Ray* rays, std::size_t count,
                              Hit* hits, unsigned char* done) {
  const unsigned known = bits_of(g.known);
  for (std::size_t k = 0; k < count; ++k) {
    done[k] = (known >> k & 1u) != 0 && rays[k].start.surface != target.surface ? 1 : 0;
    if (done[k]) hits[k] = Hit{};
  }
}

// Two groups of lanes take turns, so that neither waits for what it has just stored.
void closest_wide(const SphereTarget& target, const Ray* rays, std::size_t count, Hit* hits,
                  unsigned char* done) {
  constexpr std::size_t groups = 2;
  Group group[groups];
  Held held[groups];
  const SpherePatches* const patches = target.sphere->patches.get();
  for (std::size_t first = 0; first < count; first += groups * lane_count) {
    // Those after these: callers mostly go through an array, a packet at a time.
    const auto next = reinterpret_cast<std::uintptr_t>(rays + first) + 2 * groups * lane_count * sizeof(Ray);
    for (std::size_t line = 0; line < groups * lane_count * sizeof(Ray); line += 64)
      __builtin_prefetch(reinterpret_cast<const void*>(next + line));
    const auto begin = [&](std::size_t g) HWY_ATTR { return std::min(first + g * lane_count, count); };
    const std::size_t used = begin(1) < count ? groups : 1;
    bool hit[groups]{};
    for (std::size_t g = 0; g < used; ++g) {
      const double* in[lane_count];
      for (std::size_t k = 0; k < lane_count; ++k)
        in[k] = &rays[begin(g) + k < count ? begin(g) + k : begin(g)].origin.x;
      hit[g] = meet(target, in, group[g]);
    }
    for (std::size_t g = 0; g < used; ++g)
      if (hit[g] && patches) fetch(*patches, group[g], held[g]);
    for (std::size_t g = 0; g < used; ++g) {
      const std::size_t at = begin(g), size = begin(g + 1) - at;
      if (!hit[g]) {
        unload_misses(target, group[g], rays + at, size, hits + at, done + at);
        continue;
      }
      V u = hn::Zero(D()), v = u;
      if (patches)
        place(*patches, held[g], group[g], u, v);
      else
        hn::Store(hn::Zero(hn::RebindToSigned<D>()), hn::RebindToSigned<D>(), held[g].owners);
      unload(target, held[g], group[g], u, v, rays + at, size, hits + at, done + at);
    }
  }
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace rondure
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rondure {

HWY_EXPORT(closest_wide);

void closest_on_sphere(const SphereTarget& target, const Ray* rays, std::size_t count, Hit* hits,
                       unsigned char* done) noexcept {
  if (target.sphere->turned) {
    for (std::size_t k = 0; k < count; ++k) done[k] = 0;
    return;
  }
  HWY_DYNAMIC_DISPATCH(closest_wide)(target, rays, count, hits, done);
}

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    names.push_back(hwy::TargetName(target));
  return names;
}

void use_instruction_set(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  if (name.empty()) {
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return;
  }
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    if (name == hwy::TargetName(target)) hwy::GetChosenTarget().Update(target);
}

}  // namespace rondure
#endif
