#include "renderer/intersect/sphere_packets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

// What remains: SSE4, AVX2 and AVX-512, and plain code for all else.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/intersect/sphere_packets.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "renderer/intersect/ellipsoid_fit.h"

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

#include "renderer/intersect/sphere_kernel-inl.h"
#include "renderer/intersect/sphere_lanes-inl.h"
#include "renderer/intersect/sphere_meet-inl.h"

// What the cells and patches of a group's hits say.
struct Held {
  const SphereCell* cells[lane_count];
  const SpherePatch* patches[lane_count];
  std::int32_t owners[lane_count];
  V owned, several;  // 1 or 0
};

HWY_INLINE void fetch(const SpherePatches& all, const Group& g, Held& held) {
  alignas(64) double owned[lane_count], several[lane_count];
  for (std::size_t k = 0; k < lane_count; ++k) {
    const SphereCell& cell = all.cells[static_cast<std::size_t>(g.cell[k])];
    held.cells[k] = &cell, held.owners[k] = std::max(cell.owner, 0);
    held.patches[k] = &all.patches[static_cast<std::size_t>(held.owners[k])];
    owned[k] = cell.owner < 0 ? 0.0 : 1.0, several[k] = cell.next < 0 ? 0.0 : 1.0;
  }
  held.owned = hn::Load(D(), owned), held.several = hn::Load(D(), several);
}

// As SphereCell::start_at: pairs of floats, u and v, in the place of doubles.
HWY_INLINE void start(const Held& held, const Group& g, V& u, V& v) {
  const D d;
  const hn::Repartition<float, D> pairs;
  const hn::Rebind<float, D> df;
  const hn::RebindToUnsigned<D> du;
  const hn::Rebind<std::uint32_t, D> du32;
  const double* rows[lane_count];
  V numbers[8], more[8];
  for (std::size_t k = 0; k < lane_count; ++k)
    rows[k] = reinterpret_cast<const double*>(held.cells[k]->start);
  columns_of(d, rows, numbers);
  for (std::size_t k = 0; k < lane_count; ++k) rows[k] += 2;
  columns_of(d, rows, more);
  const auto f = [&](int k) HWY_ATTR { return hn::BitCast(pairs, k < 8 ? numbers[k] : more[k - 2]); };
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

// The points in their patches' frames; z less 1.
HWY_INLINE void turn_to_patches(const Held& held, const V* n, V& x, V& y, V& w) {
  const D d;
  const Lift<D> lift;
  V m[3][4];
  bool one_patch = true;
  for (std::size_t k = 1; k < lane_count; ++k) one_patch = one_patch && held.patches[k] == held.patches[0];
  if (one_patch) {
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) m[i][k] = lift(held.patches[0]->axes[i][k]);
  } else {
    const double* rows[lane_count];
    V last[8];
    for (std::size_t k = 0; k < lane_count; ++k) rows[k] = &held.patches[k]->axes[0].x;
    columns_of(d, rows, &m[0][0]);
    for (std::size_t k = 0; k < lane_count; ++k) rows[k] += 4;
    columns_of(d, rows, last);
    for (int k = 0; k < 4; ++k) m[2][k] = last[4 + k];
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
HWY_INLINE void place(const SpherePatches& patches, const Held& held, Group& g, V& out_u, V& out_v) {
  const D d;
  const Lift<D> lift;
  const V zero = lift(0.0), one = lift(1.0);
  V u, v, x, y, w;
  start(held, g, u, v);
  turn_to_patches(held, g.point, x, y, w);
  const M alone = hn::Eq(held.several, zero);
  M pending = hn::And(g.hit, hn::Eq(held.owned, one)), placed = hn::Lt(one, zero);
  out_u = out_v = zero;
  // Patches are mostly congruent; where not, one inverse after the other.
  const bool congruent = patches.inverses.size() == 1;
  while (!hn::AllFalse(d, pending)) {
    const std::int32_t which = held.patches[hn::FindFirstTrue(d, pending)]->inverse;
    M these = pending;
    if (!congruent) {
      alignas(64) double mine[lane_count];
      for (std::size_t k = 0; k < lane_count; ++k) mine[k] = held.patches[k]->inverse == which ? 1.0 : 0.0;
      these = hn::And(these, hn::Eq(hn::Load(d, mine), one));
    }
    pending = hn::AndNot(these, pending);
    const PatchInverse& inverse = patches.inverses[static_cast<std::size_t>(which)];
    V this_u = u, this_v = v;
    M good = inverse.degree == 2 ? parameters_at<2>(inverse, x, y, w, this_u, this_v)
                                 : parameters_at<4>(inverse, x, y, w, this_u, this_v);
    // As in_domain.
    const V middle_u = lift(inverse.middle.x), middle_v = lift(inverse.middle.y);
    const auto inside = [&](V p, V q) HWY_ATTR {
      const V farthest = inverse.middle.x == 0.5 ? hn::Max(p, q) : p + q;
      return hn::And(hn::And(hn::Ge(p, zero), hn::Ge(q, zero)), hn::Le(farthest, one));
    };
    this_u = this_u + middle_u, this_v = this_v + middle_v;
    good = hn::And(hn::And(good, these), inside(this_u, this_v));
    good = hn::And(good, hn::Or(alone, inside(u + middle_u, v + middle_v)));
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
  alignas(64) double known[lane_count], outward[lane_count];
  alignas(64) std::int64_t names[lane_count];
  hn::Store(hn::IfThenElseZero(g.known, lift(1.0)), d, known);
  double* to[lane_count];
  for (std::size_t k = 0; k < lane_count; ++k) {
    const bool mine = k < count && known[k] != 0.0 && rays[k].start.surface != target.surface;
    to[k] = mine ? &hits[k].t : nullptr;
    if (k < count) done[k] = mine ? 1 : 0;
    names[k] = static_cast<std::int64_t>(target.sphere->name_of(held.owners[k])) << 32 | target.surface;
    outward[k] = held.patches[k]->outward;
  }
  const dvec3 &frame = target.frame, &center = target.sphere->center;
  const V radius = lift(target.radius), side = hn::Load(d, outward);
  V numbers[11] = {g.t, g.t_error, hn::BitCast(d, hn::Load(di, names)), u, v};
  for (int k = 0; k < 3; ++k) {
    numbers[5 + k] = lift(frame[k]) + (lift(center[k]) + radius * g.point[k]);
    numbers[8 + k] = side * g.point[k];
  }
  const V none[3] = {lift(INFINITY), zero, hn::BitCast(d, hn::Set(di, std::int64_t{-1}))};
  for (int k = 0; k < 11; ++k) numbers[k] = hn::IfThenElse(g.hit, numbers[k], k < 3 ? none[k] : zero);
  rows_of(d, numbers, to);
  for (double*& row : to)
    if (row) row += 3;
  rows_of(d, numbers + 3, to);
}

HWY_INLINE void unload_misses(const SphereTarget& target, const Group& g, const Ray* rays, std::size_t count,
                              Hit* hits, unsigned char* done) {
  const D d;
  alignas(64) double known[lane_count];
  hn::Store(hn::IfThenElseZero(g.known, hn::Set(d, 1.0)), d, known);
  for (std::size_t k = 0; k < count; ++k) {
    done[k] = known[k] != 0.0 && rays[k].start.surface != target.surface ? 1 : 0;
    if (done[k]) hits[k] = Hit{};
  }
}

// Two groups of lanes take turns, so that neither waits for what it has just stored.
void closest_wide(const SphereTarget& target, const Ray* rays, std::size_t count, Hit* hits,
                  unsigned char* done) {
  constexpr std::size_t groups = 2;
  Group group[groups];
  Held held[groups];
  const SpherePatches& patches = *target.sphere->patches;
  for (std::size_t first = 0; first < count; first += groups * lane_count) {
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
      if (hit[g]) fetch(patches, group[g], held[g]);
    for (std::size_t g = 0; g < used; ++g) {
      const std::size_t at = begin(g), size = begin(g + 1) - at;
      if (!hit[g]) {
        unload_misses(target, group[g], rays + at, size, hits + at, done + at);
        continue;
      }
      V u, v;
      place(patches, held[g], group[g], u, v);
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
