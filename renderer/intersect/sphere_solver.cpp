#include "renderer/intersect/sphere_solver.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "renderer/bezier/quotient.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/cell.h"
#include "renderer/intersect/direction_search.h"

namespace rondure {
namespace {

#include "renderer/intersect/sphere_kernel-inl.h"

constexpr auto same = [](double x) { return x; };

template <class Shape>
dvec2 clamped(dvec2 p, double& beyond) {
  beyond = Shape::outside(p);
  return beyond > 0.0 ? Shape::clamp(p) : p;
}

dvec2 clamp_to(const SpherePatch& patch, dvec2 p, double& beyond) {
  return patch.triangle ? clamped<TriangleShape>(p, beyond) : clamped<TensorShape>(p, beyond);
}

// The surface at (u, v) in the unit sphere's space, and its derivatives.
struct Image {
  dvec3 point, du, dv;
};
Image image_at(const PatchedSphere& sphere, const Net& net, dvec2 p) {
  const FirstOrder<dvec4> s = net_first(net, p.x, p.y);
  const auto image = [&](const dvec3& x) {
    return sphere.inverse_radius > 0.0 ? x * sphere.inverse_radius : sphere.ellipsoid.inverse * x;
  };
  const dvec3 x = dvec3(s.value) / s.value.w;
  return {image(x - sphere.center), image(dvec3(s.du) - x * s.du.w) / s.value.w,
          image(dvec3(s.dv) - x * s.dv.w) / s.value.w};
}

// How many times more than about their own centre coordinates are rounded in the surface's frame.
double rounding_of(const PatchedSphere& sphere) {
  return 1.0 + largest(sphere.inverse_radius > 0.0 ? sphere.center * sphere.inverse_radius
                                                   : sphere.ellipsoid.inverse * sphere.center);
}

// Whether the surface's point at (u, v), of a patch's boundary, is n to within rounding.
bool shows(const PatchedSphere& sphere, const Net& net, dvec2 p, const dvec3& n, const Reach& reach) {
  const Image at = image_at(sphere, net, p);
  const double length2 = glm::dot(reach.direction, reach.direction);
  const dvec3 off = at.point - n;
  const double along = std::clamp(glm::dot(off, reach.direction) / length2, -reach.most, reach.most);
  const double bound = beside_roundoffs * unit_roundoff * rounding_of(sphere) +
                       unit_roundoff * (largest(at.du) + largest(at.dv));
  return largest(off - along * reach.direction) <= bound;
}

// Parameters beside the domain moved into it along the ray, by as little as that takes, if it is within
// reach; else to the nearest.
dvec2 into_domain(const PatchedSphere& sphere, const SpherePatch& patch, const Net& net, dvec2 p,
                  const Reach& reach) {
  double beyond;
  const dvec2 nearest = clamp_to(patch, p, beyond);
  const Image at = image_at(sphere, net, nearest);
  const double uu = glm::dot(at.du, at.du), uv = glm::dot(at.du, at.dv), vv = glm::dot(at.dv, at.dv);
  const double u = glm::dot(at.du, reach.direction), v = glm::dot(at.dv, reach.direction);
  const double gram = uu * vv - uv * uv;
  const dvec2 rate(quotient(vv * u - uv * v, gram), quotient(uu * v - uv * u, gram));
  double low = -reach.most, high = reach.most;
  const auto keep = [&](double value, double slope) {  // value + s slope >= 0
    if (value + (slope > 0.0 ? high : low) * slope < 0.0) low = INFINITY;
    if (slope > 0.0) low = std::max(low, -value / slope);
    if (slope < 0.0) high = std::min(high, -value / slope);
  };
  keep(p.x, rate.x), keep(p.y, rate.y);
  if (patch.triangle)
    keep(1.0 - p.x - p.y, -rate.x - rate.y);
  else
    keep(1.0 - p.x, -rate.x), keep(1.0 - p.y, -rate.y);
  if (!(low <= high) || !std::isfinite(rate.x + rate.y)) return nearest;
  return clamp_to(patch, p + std::clamp(0.0, low, high) * rate, beyond);
}

// Two steps of Newton's method on the net itself, in coordinates that keep their digits near zero: of
// singular points the polynomials a and b know only to rounding where they are.
void polish(const PatchedSphere& sphere, const Net& net, const dvec3& n, dvec2& p) {
  const dvec3 size = glm::abs(n);
  const int m = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int i = (m + 1) % 3, j = (m + 2) % 3;
  const auto project = [&](const dvec4& s) {
    const dvec3 x = sphere.ellipsoid.inverse * (dvec3(s) - sphere.center * s.w);
    return dvec2(x[i] * n[m] - x[m] * n[i], x[j] * n[m] - x[m] * n[j]);
  };
  for (int k = 0; k < 2; ++k) {
    const FirstOrder<dvec4> s = net_first(net, p.x, p.y);
    const dvec2 f = project(s.value), fu = project(s.du), fv = project(s.dv);
    const double r = quotient(1.0, fu.x * fv.y - fu.y * fv.x);
    const dvec2 move(r * (fv.y * f.x - fv.x * f.y), r * (fu.x * f.y - fu.y * f.x));
    if (!(std::max(std::fabs(move.x), std::fabs(move.y)) < 1e-6)) return;
    p -= move;
  }
}

template <int K>
bool steps_from(const PatchInverse& inverse, const SpherePatch& patch, const dvec3& n, dvec2& p) {
  const dvec4 local = patch.axes * n;
  Residual<K, double> c;
  residual_of<K>(inverse.coefficients.data(), local.x, local.y, 1.0 - local.z, c, same);
  for (int k = 0; k < inverse_steps; ++k)
    if (has_converged(step_towards_zero<K>(c, p.x, p.y, same), inverse.steepest2)) return true;
  return false;
}

// `n`: in the patches' space.
std::optional<PlaceOnSphere> in_owned_cell(const PatchedSphere& sphere, const SphereCell& cell, dvec2 p,
                                           const dvec3& n) {
  const SpherePatch& patch = sphere.patches->patches[static_cast<std::size_t>(cell.owner)];
  const PatchInverse& inverse = sphere.patches->inverses[static_cast<std::size_t>(patch.inverse)];
  const bool good =
      inverse.degree == 2 ? steps_from<2>(inverse, patch, n, p) : steps_from<4>(inverse, patch, n, p);
  if (!good) return std::nullopt;
  double beyond;
  p = clamp_to(patch, p + inverse.middle, beyond);
  if (!(beyond <= 0.0)) return std::nullopt;
  return PlaceOnSphere{sphere.name_of(cell.owner), p.x, p.y, patch.outward};
}

std::optional<PlaceOnSphere> among_candidates(const PatchedSphere& sphere, const std::vector<Net>& nets,
                                              const SphereCandidate* candidate, const dvec3& n,
                                              const Reach& reach) {
  const SpherePatches& all = *sphere.patches;
  const dvec3 turned = sphere.to_patches(n);
  const SphereCandidate* const begin = candidate;
  // Those well inside first: most points are.
  for (; candidate->patch >= 0; ++candidate) {
    const SpherePatch& patch = all.patches[static_cast<std::size_t>(candidate->patch)];
    const PatchInverse& inverse = all.inverses[static_cast<std::size_t>(patch.inverse)];
    const std::int32_t name = sphere.name_of(candidate->patch);
    dvec2 p(candidate->u, candidate->v);
    if (!(invert(inverse, patch, turned, 8, p) < 1e-14)) continue;
    double beyond;
    p += inverse.middle;
    polish(sphere, nets[static_cast<std::size_t>(name)], n, p);
    p = clamp_to(patch, p, beyond);
    if (beyond <= 0.0) return PlaceOnSphere{name, p.x, p.y, patch.outward};
  }
  for (candidate = begin; candidate->patch >= 0; ++candidate) {
    const SpherePatch& patch = all.patches[static_cast<std::size_t>(candidate->patch)];
    const PatchInverse& inverse = all.inverses[static_cast<std::size_t>(patch.inverse)];
    const std::int32_t name = sphere.name_of(candidate->patch);
    const Net& net = nets[static_cast<std::size_t>(name)];
    dvec2 p(candidate->u, candidate->v);
    if (!(invert(inverse, patch, turned, 8, p) < 1e-14)) continue;
    double beyond;
    p += inverse.middle;
    const dvec2 nearest = clamp_to(patch, p, beyond);
    // However far: beside a collapsed side rounding turns the parameter along it by any amount.
    const dvec2 q = beyond < 1e-3 ? into_domain(sphere, patch, net, p, reach) : nearest;
    if (shows(sphere, net, q, n, reach)) return PlaceOnSphere{name, q.x, q.y, patch.outward};
  }
  // Newton's method settles at none, or where the polynomials have another zero.
  for (candidate = begin; candidate->patch >= 0; ++candidate) {
    const SpherePatch& patch = all.patches[static_cast<std::size_t>(candidate->patch)];
    const std::int32_t name = sphere.name_of(candidate->patch);
    const Net& net = nets[static_cast<std::size_t>(name)];
    const auto found = search_direction(image_of(sphere, net), n, rounding_of(sphere));
    if (found && shows(sphere, net, *found, n, reach))
      return PlaceOnSphere{name, found->x, found->y, patch.outward};
  }
  return std::nullopt;
}

}  // namespace

PatchedSphere without_patches(const Ellipsoid& ellipsoid) {
  PatchedSphere out;
  out.ellipsoid = ellipsoid, out.outward = 1.0, out.error = ellipsoid_error(ellipsoid);
  if (const double r = ellipsoid.uniform_radius; r > smallest_radius && r < largest_radius)
    out.radius = r, out.inverse_radius = 1.0 / r;
  return out;
}

Net image_of(const PatchedSphere& sphere, const Net& net) {
  Net image = net;
  for (dvec4& p : points_of(image))
    p = dvec4(sphere.ellipsoid.inverse * (dvec3(p) - sphere.center * p.w), p.w);
  return image;
}

bool meet_sphere(const PatchedSphere& sphere, const dvec3& origin, const dvec3& frame, LocalRay& ray,
                 SphereRoots& roots) noexcept {
  const dvec3 &o = ray.base, &d = ray.direction;
  const double inverse_length2 = 1.0 / ray.length2;
  // As set_base, about a point that is no double.
  TwoFold away[3];
  dvec3 low;
  for (int k = 0; k < 3; ++k) {
    const TwoFold center = two_sum(frame[k], sphere.center[k]);
    away[k] = two_sum(center.high, -origin[k]);
    low[k] = away[k].low + center.low;
  }
  ray.slide = ((away[0].high * d.x + away[1].high * d.y) + away[2].high * d.z) * inverse_length2;
  if (!(std::fabs(ray.slide) < 0x1p990)) return false;
  for (int k = 0; k < 3; ++k) ray.base[k] = std::fma(ray.slide, d[k], -away[k].high) - low[k];

  double rest;
  if (sphere.inverse_radius > 0.0) {
    const double radius = sphere.ellipsoid.uniform_radius;
    const auto chord = [&] {
      return chord_of(o.x, o.y, o.z, d.x, d.y, d.z, inverse_length2, radius * radius, same);
    };
    SphereChord<double> c = chord();
    if (const double most = farthest_middle2 * radius * radius; !(c.passed2 <= most)) {
      ray.base += c.middle * d, ray.slide += c.middle;
      c = chord();
      if (!(c.passed2 <= most)) return false;
    }
    rest = c.rest, roots.middle = roots.from_middle = c.middle;
    roots.inverse_length2 = inverse_length2;
    roots.from = sphere.inverse_radius * o, roots.direction = sphere.inverse_radius * d;
  } else {
    const dvec3 p = sphere.ellipsoid.inverse * o;
    roots.direction = sphere.ellipsoid.inverse * d;
    roots.inverse_length2 = 1.0 / glm::dot(roots.direction, roots.direction);
    // The point nearest to the centre is another here.
    roots.middle = -glm::dot(p, roots.direction) * roots.inverse_length2, roots.from_middle = 0.0;
    roots.from = p + roots.middle * roots.direction;
    rest = 1.0 - glm::dot(roots.from, roots.from);
  }
  if (!(rest >= 0.0)) return false;
  roots.half = std::sqrt(rest * roots.inverse_length2);
  return true;
}

SpherePoint sphere_point(const SphereRoots& r, int side) noexcept {
  const double way = side < 0 ? r.from_middle - r.half : r.from_middle + r.half;
  SpherePoint out;
  out.n = out.rough = r.from + way * r.direction;
  settle_point(out.n.x, out.n.y, out.n.z, same);
  return out;
}

std::optional<PlaceOnSphere> place_on_sphere(const PatchedSphere& sphere, const std::vector<Net>& nets,
                                             const SpherePoint& point, const Reach& reach) noexcept {
  if (!sphere.patches) return PlaceOnSphere{0, 0.0, 0.0, sphere.outward};
  const SpherePatches& patches = *sphere.patches;
  const CellPlace at = cell_at(sphere.to_patches(point.rough), patches.cells_a_side);
  const SphereCell& cell = patches.cells[at.cell];
  dvec2 start;
  if (const SphereCell& mine = cell_around(patches, at, start); mine.owner >= 0)
    if (const auto place = in_owned_cell(sphere, mine, start, sphere.to_patches(point.n))) return place;
  if (cell.others >= 0)
    return among_candidates(sphere, nets, &patches.candidates[static_cast<std::size_t>(cell.others)], point.n,
                            reach);
  if (cell.owner < 0) return std::nullopt;
  const SphereCandidate alone[2] = {{cell.owner, cell.start[0][0], cell.start[0][1]}, {-1, 0.0f, 0.0f}};
  return among_candidates(sphere, nets, alone, point.n, reach);
}

bool covers(const PatchedSphere& sphere, const std::vector<Net>& nets, const SpherePoint& point,
            const Reach& reach) noexcept {
  if (!sphere.patches) return true;
  const CellPlace at = cell_at(sphere.to_patches(point.rough), sphere.patches->cells_a_side);
  const SphereCell& cell = sphere.patches->cells[at.cell];
  return (cell.owner >= 0 && cell.others < 0) || place_on_sphere(sphere, nets, point, reach).has_value();
}

}  // namespace rondure
