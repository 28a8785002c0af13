#include "renderer/intersect/sphere_packets.h"

#include <algorithm>

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

namespace hn = hwy::HWY_NAMESPACE;

#include "renderer/intersect/sphere_kernel-inl.h"
#include "renderer/intersect/sphere_lanes-inl.h"

// Parameters at the points n of patches with one inverse; lanes that have not converged are not in `good`.
template <int K, class D, class V, class M>
HWY_INLINE void parameters_at(D d, const PatchInverse& inverse, V x, V y, V w, V& u, V& v, M& good) {
  constexpr double converged = 1e-32;
  Residual<K, V> c;
  residual_of<K>(inverse.coefficients.data(), x, y, w, c, Lift<D>());
  V first2, second2, steep2;
  two_steps<K>(c, u, v, first2, second2, steep2, Lift<D>());
  good = hn::Le(first2 * second2, hn::Set(d, converged));
  const V steepest2 = hn::Set(d, inverse.steepest2);
  good = hn::And(good, hn::Le(steep2, steepest2));
  if (hn::AllTrue(d, good)) return;
  V more_u = u, more_v = v;
  two_steps<K>(c, more_u, more_v, first2, second2, steep2, Lift<D>());
  u = hn::IfThenElse(good, u, more_u), v = hn::IfThenElse(good, v, more_v);
  good = hn::Or(good, hn::And(hn::Le(first2 * second2, hn::Set(d, converged)), hn::Le(steep2, steepest2)));
}

// The lanes' cells and owners, and what those say; lanes without an owner get those of some patch, and `ok`
// 0.
template <std::size_t N>
HWY_INLINE void fetch(const SpherePatches& patches, Lanes<N>& lanes, std::int32_t* owner) {
  for (std::size_t k = 0; k < N; ++k) {
    const SphereCell& cell = patches.cells[static_cast<std::size_t>(lanes.cell[k])];
    owner[k] = cell.owner;
    if (cell.owner < 0) lanes.ok[k] = 0.0, owner[k] = 0;
    for (int i = 0; i < 6; ++i) lanes.start[i][k] = cell.u[i], lanes.start[6 + i][k] = cell.v[i];
    const SpherePatch& patch = patches.patches[static_cast<std::size_t>(owner[k])];
    for (int i = 0; i < 9; ++i) lanes.axes[i][k] = patch.axes[i / 3][i % 3];
  }
}

// From the rays to points of the sphere and their cells. ok[k] becomes 1 for a hit, 0 for a ray to be handed
// back, -1 for a miss. False when no lane has a hit.
template <class D, std::size_t N>
HWY_INLINE bool meet(D d, const SphereTarget& target, Lanes<N>& lanes) {
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  const hn::RebindToSigned<D> di;
  const Lift<D> lift;
  const PatchedSphere& sphere = *target.sphere;
  const V zero = lift(0.0), one = lift(1.0);

  V ox = hn::Load(d, lanes.origin[0]), oy = hn::Load(d, lanes.origin[1]), oz = hn::Load(d, lanes.origin[2]);
  V dx = hn::Load(d, lanes.direction[0]), dy = hn::Load(d, lanes.direction[1]),
    dz = hn::Load(d, lanes.direction[2]);
  // As set_direction: a power of two brings the largest component to [1, 2).
  const V size = hn::Max(hn::Max(hn::Abs(dx), hn::Abs(dy)), hn::Abs(dz));
  const auto exponent = hn::And(hn::BitCast(di, size), hn::Set(di, std::int64_t{0x7ff0000000000000}));
  const V scale = hn::BitCast(d, hn::Set(di, std::int64_t{2046} << 52) - exponent);
  M ok = hn::And(hn::Gt(size, lift(0x1p-900)), hn::Lt(size, lift(0x1p900)));
  const V sum = ((ox - ox) + (oy - oy) + (oz - oz)) + ((dx - dx) + (dy - dy) + (dz - dz));
  ok = hn::And(ok, hn::Eq(sum, zero));
  dx = dx * scale, dy = dy * scale, dz = dz * scale;
  const V length2 = (dx * dx + dy * dy) + dz * dz;

  // As set_base.
  const Product<V> away[3] = {exact_sum(lift(target.frame.x), zero - ox),
                              exact_sum(lift(target.frame.y), zero - oy),
                              exact_sum(lift(target.frame.z), zero - oz)};
  const V slide = ((away[0].high * dx + away[1].high * dy) + away[2].high * dz) / length2;
  ok = hn::And(ok, hn::Lt(hn::Abs(slide), lift(0x1p900)));
  V base[3];
  const V along[3] = {dx, dy, dz};
  for (int k = 0; k < 3; ++k) {
    const Product<V> step = exact_product(d, slide, along[k]);
    const Product<V> total = exact_sum(step.high, zero - away[k].high);
    base[k] = total.high + (total.low + (step.low - away[k].low));
  }

  const V inverse_radius = lift(sphere.inverse_radius);
  const SphereChord<V> chord = chord_of((base[0] - lift(sphere.center.x)) * inverse_radius,
                                        (base[1] - lift(sphere.center.y)) * inverse_radius,
                                        (base[2] - lift(sphere.center.z)) * inverse_radius,
                                        dx * inverse_radius, dy * inverse_radius, dz * inverse_radius, lift);
  M hit = hn::And(ok, hn::Ge(chord.rest, zero));
  const V half = hn::Sqrt(hn::Max(chord.rest, zero) * chord.inverse_length2);
  const V t_min = hn::Load(d, lanes.t_min), t_max = hn::Load(d, lanes.t_max);
  const V enter = (slide + (chord.middle - half)) * scale, leave = (slide + (chord.middle + half)) * scale;
  const M enters = hn::And(hn::Ge(enter, t_min), hn::Le(enter, t_max)),
          leaves = hn::And(hn::Ge(leave, t_min), hn::Le(leave, t_max));
  hit = hn::And(hit, hn::Or(enters, leaves));
  hn::Store(hn::IfThenElse(ok, hn::IfThenElse(hit, one, lift(-1.0)), zero), d, lanes.ok);
  if (hn::AllFalse(d, hit)) return false;

  const V way = hn::IfThenElse(enters, zero - half, half), s = chord.middle + way;
  const V t = hn::IfThenElse(enters, enter, leave);
  V x, y, z;
  point_at(chord, way, x, y, z, lift);
  const double error = ellipsoid_error(sphere.ellipsoid);
  const V grazing = lift(std::sqrt(2.0 * error * sphere.ellipsoid.extent));
  const V shift = lift(error * sphere.inverse_radius) * chord.inverse_length2 / half;
  const V s_error =
      lift(2.0) * hn::IfThenElse(hn::Lt(grazing, shift), grazing, shift) + lift(0x1p-52) * hn::Abs(slide + s);
  hn::Store(t, d, lanes.t);
  hn::Store(s_error * scale, d, lanes.t_error);
  const V radius = lift(sphere.ellipsoid.uniform_radius);
  hn::Store(lift(target.frame.x) + (lift(sphere.center.x) + radius * x), d, lanes.point[0]);
  hn::Store(lift(target.frame.y) + (lift(sphere.center.y) + radius * y), d, lanes.point[1]);
  hn::Store(lift(target.frame.z) + (lift(sphere.center.z) + radius * z), d, lanes.point[2]);
  hn::Store(x, d, lanes.normal[0]), hn::Store(y, d, lanes.normal[1]), hn::Store(z, d, lanes.normal[2]);

  // As cell_at.
  const SpherePatches& patches = sphere.patches;
  const V ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
  const M is_x = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az)), is_y = hn::AndNot(is_x, hn::Ge(ay, az));
  const V major = hn::IfThenElse(is_x, x, hn::IfThenElse(is_y, y, z)),
          second = hn::IfThenElse(is_x, y, hn::IfThenElse(is_y, z, x)),
          third = hn::IfThenElse(is_x, z, hn::IfThenElse(is_y, x, y));
  const V side = lift(patches.cells_a_side), last = lift(patches.cells_a_side - 1), middle = lift(0.5) * side;
  const V face = hn::IfThenElse(is_x, zero, hn::IfThenElse(is_y, lift(2.0), lift(4.0))) +
                 hn::IfThenElse(hn::Lt(major, zero), one, zero);
  const V r = one / hn::Abs(major);
  const V g = (second * r + one) * middle, h = (third * r + one) * middle;
  const V row = hn::Min(hn::Floor(g), last), column = hn::Min(hn::Floor(h), last);
  // Lanes without a hit hold anything: any cell will do.
  const V index = (face * side + row) * side + column;
  hn::Store(hn::ConvertTo(di, hn::IfThenElse(hit, index, zero)), di, lanes.cell);
  hn::Store(lift(2.0) * (g - row) - one, d, lanes.a);
  hn::Store(lift(2.0) * (h - column) - one, d, lanes.b);
  return true;
}

// The parameters of the hits. Lanes whose patch does not hold them, or has not told in a few steps, are
// handed back.
template <class D, std::size_t N>
HWY_INLINE void place(D d, const SpherePatches& patches, Lanes<N>& lanes, const std::int32_t* owner) {
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  const hn::Rebind<float, D> df;
  const Lift<D> lift;
  const V zero = lift(0.0), one = lift(1.0);
  const V a = hn::Load(d, lanes.a), b = hn::Load(d, lanes.b);
  const V x = hn::Load(d, lanes.normal[0]), y = hn::Load(d, lanes.normal[1]),
          z = hn::Load(d, lanes.normal[2]);
  V f[12];
  for (int k = 0; k < 12; ++k) f[k] = hn::PromoteTo(d, hn::Load(df, lanes.start[k]));
  const auto start = [&](const V* q) HWY_ATTR {
    return ((q[0] + q[1] * a) + q[2] * b) + ((q[3] * a) * a + (q[4] * a + q[5] * b) * b);
  };
  V u = start(f), v = start(f + 6);
  V m[9];
  for (int k = 0; k < 9; ++k) m[k] = hn::Load(d, lanes.axes[k]);
  const V px = (m[0] * x + m[1] * y) + m[2] * z, py = (m[3] * x + m[4] * y) + m[5] * z,
          pw = one - ((m[6] * x + m[7] * y) + m[8] * z);

  // Patches are mostly congruent; where not, one inverse after the other.
  V out_u = zero, out_v = zero;
  M all_good = hn::Lt(one, zero);
  bool pending[N], several = false;
  std::int32_t which[N];
  for (std::size_t k = 0; k < N; ++k) {
    pending[k] = lanes.ok[k] == 1.0;
    which[k] = patches.patches[static_cast<std::size_t>(owner[k])].inverse;
  }
  for (std::size_t k = 0; k < N; ++k) {
    if (!pending[k]) continue;
    alignas(64) double mine[N];
    bool all = !several;
    for (std::size_t j = 0; j < N; ++j) {
      const bool same = pending[j] && which[j] == which[k];
      mine[j] = same ? 1.0 : 0.0;
      all = all && (same || !pending[j]);
    }
    for (std::size_t j = 0; j < N; ++j) pending[j] = pending[j] && mine[j] == 0.0;
    const M these = all ? hn::Gt(one, zero) : hn::Gt(hn::Load(d, mine), zero);
    const PatchInverse& inverse = patches.inverses[static_cast<std::size_t>(which[k])];
    V this_u = u, this_v = v;
    M good;
    if (inverse.degree == 2)
      parameters_at<2>(d, inverse, px, py, pw, this_u, this_v, good);
    else
      parameters_at<4>(d, inverse, px, py, pw, this_u, this_v, good);
    this_u = this_u + lift(inverse.middle.x), this_v = this_v + lift(inverse.middle.y);
    good = hn::And(good, hn::And(hn::Ge(this_u, zero), hn::Ge(this_v, zero)));
    const V farthest = inverse.middle.x == 0.5 ? hn::Max(this_u, this_v) : this_u + this_v;
    good = hn::And(hn::And(good, these), hn::Le(farthest, one));
    out_u = hn::IfThenElse(these, this_u, out_u), out_v = hn::IfThenElse(these, this_v, out_v);
    all_good = hn::Or(all_good, good);
    if (all) break;
    several = true;
  }
  hn::Store(out_u, d, lanes.u), hn::Store(out_v, d, lanes.v);
  const V state = hn::Load(d, lanes.ok);
  hn::Store(hn::IfThenElse(hn::And(hn::Eq(state, one), hn::Not(all_good)), zero, state), d, lanes.ok);
}

template <class D, std::size_t N>
HWY_INLINE void load(const Ray* rays, std::size_t count, Lanes<N>& lanes) {
  for (std::size_t k = 0; k < N; ++k) {
    const Ray& ray = rays[k < count ? k : 0];
    for (int i = 0; i < 3; ++i) lanes.origin[i][k] = ray.origin[i], lanes.direction[i][k] = ray.direction[i];
    lanes.t_min[k] = ray.t_min, lanes.t_max[k] = ray.t_max;
  }
}

template <std::size_t N>
HWY_INLINE void unload(const SphereTarget& target, const Lanes<N>& lanes, const std::int32_t* owner,
                       const Ray* rays, std::size_t count, Hit* hits, unsigned char* done) {
  for (std::size_t k = 0; k < count; ++k) {
    Hit& hit = hits[k];
    const bool mine = lanes.ok[k] != 0.0 && rays[k].start.surface != target.surface;
    done[k] = mine ? 1 : 0;
    if (!mine) continue;
    if (lanes.ok[k] < 0.0) {
      hit = Hit{};
      continue;
    }
    const SpherePatch& patch = target.sphere->patches.patches[static_cast<std::size_t>(owner[k])];
    hit.t = lanes.t[k], hit.t_error = lanes.t_error[k];
    hit.surface = target.surface, hit.patch = patch.patch;
    hit.u = lanes.u[k], hit.v = lanes.v[k];
    hit.point = {lanes.point[0][k], lanes.point[1][k], lanes.point[2][k]};
    hit.normal = dvec3(lanes.normal[0][k], lanes.normal[1][k], lanes.normal[2][k]) * patch.outward;
  }
}

// Two groups of lanes take turns, so that what one has stored has reached memory when it is read again.
template <class D>
HWY_INLINE void run(D d, const SphereTarget& target, const Ray* rays, std::size_t count, Hit* hits,
                    unsigned char* done) {
  constexpr std::size_t N = hn::MaxLanes(D()), groups = N == 1 ? 1 : 2;
  Lanes<N> lanes[groups];
  std::int32_t owner[groups][N]{};
  const SpherePatches& patches = target.sphere->patches;
  for (std::size_t first = 0; first < count; first += groups * N) {
    const auto begin = [&](std::size_t g) HWY_ATTR { return std::min(first + g * N, count); };
    const std::size_t used = begin(1) < count ? groups : 1;
    bool hit[groups]{};
    for (std::size_t g = 0; g < used; ++g) load<D>(rays + begin(g), begin(g + 1) - begin(g), lanes[g]);
    for (std::size_t g = 0; g < used; ++g) hit[g] = meet<D, N>(d, target, lanes[g]);
    for (std::size_t g = 0; g < used; ++g)
      if (hit[g]) fetch(patches, lanes[g], owner[g]);
    for (std::size_t g = 0; g < used; ++g)
      if (hit[g]) place<D, N>(d, patches, lanes[g], owner[g]);
    for (std::size_t g = 0; g < used; ++g)
      unload(target, lanes[g], owner[g], rays + begin(g), begin(g + 1) - begin(g), hits + begin(g),
             done + begin(g));
  }
}

void closest_wide(const SphereTarget& target, const Ray* rays, std::size_t count, Hit* hits,
                  unsigned char* done) {
  run(hn::CappedTag<double, 8>(), target, rays, count, hits, done);
}
void closest_single(const SphereTarget& target, const Ray* rays, std::size_t count, Hit* hits,
                    unsigned char* done) {
  run(hn::CappedTag<double, 1>(), target, rays, count, hits, done);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace rondure
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rondure {

HWY_EXPORT(closest_wide);
HWY_EXPORT(closest_single);

void closest_on_sphere(const SphereTarget& target, const Ray* rays, std::size_t count, Hit* hits,
                       unsigned char* done) noexcept {
  if (!(target.sphere->inverse_radius > 0.0)) {
    for (std::size_t k = 0; k < count; ++k) done[k] = 0;
    return;
  }
  if (count == 1)
    HWY_DYNAMIC_DISPATCH(closest_single)(target, rays, count, hits, done);
  else
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
