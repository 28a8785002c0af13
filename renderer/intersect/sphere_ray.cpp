#include "renderer/intersect/sphere_ray.h"

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/intersect/sphere_ray.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "renderer/intersect/contact.h"

HWY_BEFORE_NAMESPACE();
namespace rondure {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

#include "renderer/intersect/sphere_kernel-inl.h"
#include "renderer/intersect/sphere_spread-inl.h"
#include "renderer/intersect/sphere_triple-inl.h"

template <int K>
HWY_INLINE bool find_parameters(const PatchInverse& inverse, const SpherePatch& patch, const dvec3& n,
                                double& u, double& v) {
  const auto& a = patch.axes;
  const Triple local = (Triple::of_four(&a[0].x) * Triple(n.x) + Triple::of_four(&a[1].x) * Triple(n.y)) +
                       Triple::of_four(&a[2].x) * Triple(n.z);
  const Spread<K> c(inverse, local.x(), local.y(), 1.0 - local.z());
  for (int k = 0; k < inverse_steps; ++k)
    if (has_converged(c.step(u, v), inverse.steepest2)) return true;
  return false;
}

// Where the ray meets the sphere first, within its range.
struct Meeting {
  double t, t_error;
  dvec3 point;  // of the unit sphere
  CellPlace cell;
};

static_assert(offsetof(Ray, direction) == 3 * sizeof(double) && offsetof(Ray, t_min) == 6 * sizeof(double));

HWY_INLINE RayAnswer meet(const SphereTarget& target, const Ray& ray, double farthest, Meeting& out) {
  const double* numbers = &ray.origin.x;
  // Of what is fourth nothing is used.
  const Triple o = Triple::of_four(numbers), d = Triple::of_four(numbers + 3),
               center = Triple::of_four(&target.center.x), center_low = Triple::of_four(&target.center_low.x);
  const double length2 = dot(d, d);
  // As set_direction, whose power of two changes no bit of what follows where that does not leave doubles'
  // range.
  if (!(length2 > shortest_direction2 && length2 < longest_direction2)) return RayAnswer::unknown;
  const double inverse_length2 = 1.0 / length2;

  // As meet_sphere.
  const Triple away = center - o, taken = away - center, low = (center - (away - taken)) - (o + taken);
  const double slide = dot(away, d) * inverse_length2;
  if (!(std::fabs(slide) < farthest_slide)) return RayAnswer::unknown;
  const Triple from = fused(Triple(slide), d, away) - (low + center_low);

  // As chord_of.
  const double back = 0.0 - dot(from, d), middle = back * inverse_length2, passed2 = back * middle;
  const double rest = (target.radius2 - dot(from, from)) + passed2;
  if (!(passed2 <= farthest_middle2 * target.radius2)) return RayAnswer::unknown;
  if (!(rest >= 0.0)) return RayAnswer::miss;
  // Beside tangency the bound on t takes another form.
  if (rest < target.stretch) return RayAnswer::unknown;
  const double half = std::sqrt(rest * inverse_length2), enter = middle - half, leave = middle + half;
  const double t_enter = slide + enter, t_leave = slide + leave;
  // Which of two at the same t comes first is not for this to say.
  if (t_enter == t_leave) return RayAnswer::unknown;
  const bool enters = t_enter >= ray.t_min && t_enter <= ray.t_max,
             leaves = t_leave >= ray.t_min && t_leave <= ray.t_max;
  // Where a ray has left another surface, what is just behind it may yet be met.
  if (!enters && ray.start.surface >= 0) return RayAnswer::unknown;
  if (!enters && !leaves) return RayAnswer::miss;
  // And where it does so at this one, what is just ahead may not.
  if (ray.start.surface >= 0 && t_enter * t_enter * length2 < contact_reach * contact_reach * target.radius2)
    return RayAnswer::unknown;
  out.t = enters ? t_enter : t_leave;
  if (out.t > farthest) return RayAnswer::miss;

  // As sphere_point.
  const Triple shrink(target.inverse_radius);
  const Triple rough = shrink * from + Triple(enters ? enter : leave) * (shrink * d);
  if (const SpherePatches* patches = target.sphere->patches.get())
    out.cell = cell_at(target.sphere->to_patches(rough.vector()), patches->cells_a_side);
  const double off = (1.0 - dot(rough, rough)) * 0.5;
  out.point = (rough + Triple(off) * rough).vector();
  out.t_error = 2.0 * (target.stretch * inverse_length2 / half) + 0x1p-52 * std::fabs(out.t);
  return RayAnswer::hit;
}

// Which patch of a cell holds the point, by the ordinary way; -1 where it takes more.
HWY_INLINE std::int32_t place(const PatchedSphere& sphere, const Meeting& at, dvec2& p) {
  const SpherePatches& patches = *sphere.patches;
  const SphereCell& cell = cell_around(patches, at.cell, p);
  if (cell.owner < 0) return -1;
  const SpherePatch& patch = patches.patches[static_cast<std::size_t>(cell.owner)];
  const PatchInverse& inverse = patches.inverses[static_cast<std::size_t>(patch.inverse)];
  const dvec3 point = sphere.to_patches(at.point);
  const bool good = inverse.degree == 2 ? find_parameters<2>(inverse, patch, point, p.x, p.y)
                                        : find_parameters<4>(inverse, patch, point, p.x, p.y);
  if (!good || !in_domain(inverse, patch.triangle, p)) return -1;
  p += inverse.middle;
  return cell.owner;
}

RayAnswer closest(const SphereTarget& target, const Ray& ray, double farthest, Hit& hit) {
  Meeting at;
  if (const RayAnswer answer = meet(target, ray, farthest, at); answer != RayAnswer::hit) return answer;
  const PatchedSphere& sphere = *target.sphere;
  dvec2 p(0.0);
  double outward = sphere.outward;
  hit.patch = 0;
  if (sphere.patches) {
    const std::int32_t patch = place(sphere, at, p);
    if (patch < 0) return RayAnswer::unknown;
    outward = sphere.patches->patches[static_cast<std::size_t>(patch)].outward;
    hit.patch = sphere.name_of(patch);
  }
  hit.t = at.t, hit.t_error = at.t_error;
  hit.surface = target.surface, hit.u = p.x, hit.v = p.y;
  hit.point = target.frame + (sphere.center + target.radius * at.point);
  hit.normal = outward * at.point;
  return RayAnswer::hit;
}

RayAnswer occludes(const SphereTarget& target, const Ray& ray) {
  Meeting at;
  if (const RayAnswer answer = meet(target, ray, INFINITY, at); answer != RayAnswer::hit) return answer;
  if (!target.sphere->patches) return RayAnswer::hit;
  const SphereCell& cell = target.sphere->patches->cells[at.cell.cell];
  dvec2 p;
  if ((cell.owner >= 0 && cell.others < 0) || place(*target.sphere, at, p) >= 0) return RayAnswer::hit;
  return RayAnswer::unknown;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace rondure
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rondure {

HWY_EXPORT(closest);
HWY_EXPORT(occludes);

SphereTarget target_at(const PatchedSphere& sphere, const dvec3& frame, int surface) {
  SphereTarget target;
  target.frame = frame, target.sphere = &sphere, target.surface = surface;
  for (int k = 0; k < 3; ++k) {
    const TwoFold sum = two_sum(frame[k], sphere.center[k]);
    target.center[k] = sum.high, target.center_low[k] = sum.low;
  }
  target.radius = sphere.radius;
  target.radius2 = target.radius * target.radius, target.inverse_radius = sphere.inverse_radius;
  target.stretch = sphere.error * target.radius;
  return target;
}

RayAnswer closest_on_sphere(const SphereTarget& target, const Ray& ray, double farthest, Hit& hit) noexcept {
  if (ray.start.surface == target.surface) return RayAnswer::unknown;
  return HWY_DYNAMIC_DISPATCH(closest)(target, ray, farthest, hit);
}

RayAnswer sphere_occludes(const SphereTarget& target, const Ray& ray) noexcept {
  if (ray.start.surface == target.surface) return RayAnswer::unknown;
  return HWY_DYNAMIC_DISPATCH(occludes)(target, ray);
}

}  // namespace rondure
#endif
