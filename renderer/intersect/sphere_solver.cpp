#include "renderer/intersect/sphere_solver.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "renderer/bezier/quotient.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/clipping.h"
#include "renderer/intersect/ellipsoid_fit.h"
#include "renderer/intersect/projected_net.h"
#include "renderer/intersect/settle.h"

namespace rondure {
namespace {

#include "renderer/intersect/sphere_kernel-inl.h"

constexpr auto same = [](double x) { return x; };
// Squares of lengths: the product of two steps whose lengths have this product leaves rounding.
constexpr double converged = 1e-32;

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

// Whether the surface's point at (u, v), of a patch's boundary, is n to within rounding.
bool shows(const PatchedSphere& sphere, const Net& net, dvec2 p, const dvec3& n, const Reach& reach) {
  const Image at = image_at(sphere, net, p);
  const double length2 = glm::dot(reach.direction, reach.direction);
  const dvec3 off = at.point - n;
  const double along = std::clamp(glm::dot(off, reach.direction) / length2, -reach.most, reach.most);
  const dvec3 center = sphere.inverse_radius > 0.0 ? sphere.center * sphere.inverse_radius
                                                   : sphere.ellipsoid.inverse * sphere.center;
  const double bound = beside_roundoffs * unit_roundoff * (1.0 + largest(center)) +
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

// The net in the unit sphere's space.
Net image_of(const PatchedSphere& sphere, const Net& net) {
  Net image = net;
  for (dvec4& p : points_of(image))
    p = dvec4(sphere.ellipsoid.inverse * (dvec3(p) - sphere.center * p.w), p.w);
  return image;
}

// The parameters at which the patch shows the direction n, by subdivision: where Newton's method does not
// settle. Of several, those whose point is nearest.
std::optional<dvec2> search(const PatchedSphere& sphere, const Net& net, const dvec3& n) {
  LocalRay ray;  // through the centre
  if (!set_direction(n, ray)) return std::nullopt;
  set_normals(ray);
  set_distances(ray);
  const Net image = image_of(sphere, net);
  NetScale scale;
  dvec2 projected[max_net_size];
  project_net(points_of(image), ray, projected);
  for (const dvec4& p : points_of(image)) {
    scale.position = std::max(scale.position, largest(dvec3(p)));
    scale.weight = std::max(scale.weight, p.w);
  }
  const double error = residual_bound(scale, ray);
  std::vector<Root> roots;
  SearchCounts counts;
  counts.limit = 1 << 12;
  if (const auto* tensor = std::get_if<TensorNet>(&image))
    find_roots(TensorShape{tensor->m, tensor->n}, projected, RectangleCell{}, error, roots, counts);
  else
    find_roots(TriangleShape{std::get<TriangleNet>(image).n}, projected, TriangleCell{}, error, roots,
               counts);
  std::optional<dvec2> best;
  double least = 1e-6;
  for (Root root : roots) {
    settle(image, scale, ray, root);
    const double off = largest(net_point(image, root.u, root.v) - n);
    if (off < least) least = off, best = {root.u, root.v};
  }
  return best;
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
  const auto& a = patch.axes;
  const double x = (a[0].x * n.x + a[0].y * n.y) + a[0].z * n.z,
               y = (a[1].x * n.x + a[1].y * n.y) + a[1].z * n.z,
               w = 1.0 - ((a[2].x * n.x + a[2].y * n.y) + a[2].z * n.z);
  Residual<K, double> c;
  residual_of<K>(inverse.coefficients.data(), x, y, w, c, same);
  double first2 = 0.0, second2 = 0.0, steep2 = 0.0;
  for (int k = 0; k < 2; ++k) {
    two_steps<K>(c, p.x, p.y, first2, second2, steep2, same);
    if (first2 * second2 <= converged && steep2 <= inverse.steepest2) return true;
  }
  return false;
}

std::optional<PlaceOnSphere> in_owned_cell(const PatchedSphere& sphere, const SphereCell& cell,
                                           const CellPlace& at, const dvec3& n) {
  const SpherePatch& patch = sphere.patches.patches[static_cast<std::size_t>(cell.owner)];
  const PatchInverse& inverse = sphere.patches.inverses[static_cast<std::size_t>(patch.inverse)];
  const double a = at.a, b = at.b;
  const auto start = [&](const float* f) {
    return ((f[0] + f[1] * a) + f[2] * b) + ((f[3] * a) * a + (f[4] * a + f[5] * b) * b);
  };
  dvec2 p(start(cell.u), start(cell.v));
  const bool good =
      inverse.degree == 2 ? steps_from<2>(inverse, patch, n, p) : steps_from<4>(inverse, patch, n, p);
  if (!good) return std::nullopt;
  double beyond;
  p = clamp_to(patch, p + inverse.middle, beyond);
  if (!(beyond <= 0.0)) return std::nullopt;
  return PlaceOnSphere{patch.patch, p.x, p.y, patch.outward};
}

std::optional<PlaceOnSphere> among_candidates(const PatchedSphere& sphere, const std::vector<Net>& nets,
                                              const SphereCandidate* candidate, const dvec3& n,
                                              const Reach& reach) {
  const SpherePatches& all = sphere.patches;
  const SphereCandidate* const begin = candidate;
  // Those well inside first: most points are.
  for (; candidate->patch >= 0; ++candidate) {
    const SpherePatch& patch = all.patches[static_cast<std::size_t>(candidate->patch)];
    const PatchInverse& inverse = all.inverses[static_cast<std::size_t>(patch.inverse)];
    dvec2 p(candidate->u, candidate->v);
    if (!(invert(inverse, patch, n, 8, p) < 1e-14)) continue;
    double beyond;
    p += inverse.middle;
    polish(sphere, nets[static_cast<std::size_t>(patch.patch)], n, p);
    p = clamp_to(patch, p, beyond);
    if (beyond <= 0.0) return PlaceOnSphere{patch.patch, p.x, p.y, patch.outward};
  }
  for (candidate = begin; candidate->patch >= 0; ++candidate) {
    const SpherePatch& patch = all.patches[static_cast<std::size_t>(candidate->patch)];
    const PatchInverse& inverse = all.inverses[static_cast<std::size_t>(patch.inverse)];
    const Net& net = nets[static_cast<std::size_t>(patch.patch)];
    dvec2 p(candidate->u, candidate->v);
    if (invert(inverse, patch, n, 8, p) < 1e-14) {
      double beyond;
      p += inverse.middle;
      const dvec2 nearest = clamp_to(patch, p, beyond);
      // However far: beside a collapsed side rounding turns the parameter along it by any amount.
      const dvec2 q = beyond < 1e-3 ? into_domain(sphere, patch, net, p, reach) : nearest;
      if (shows(sphere, net, q, n, reach)) return PlaceOnSphere{patch.patch, q.x, q.y, patch.outward};
      if (beyond > 1e-3) continue;
    }
    if (const auto found = search(sphere, net, n); found && shows(sphere, net, *found, n, reach))
      return PlaceOnSphere{patch.patch, found->x, found->y, patch.outward};
  }
  return std::nullopt;
}

}  // namespace

bool meet_sphere(const PatchedSphere& sphere, const LocalRay& ray, SphereRoots& roots) noexcept {
  dvec3 o = ray.base - sphere.center, d = ray.direction;
  if (sphere.inverse_radius > 0.0)
    o *= sphere.inverse_radius, d *= sphere.inverse_radius;
  else
    o = sphere.ellipsoid.inverse * o, d = sphere.ellipsoid.inverse * d;
  const SphereChord<double> c = chord_of(o.x, o.y, o.z, d.x, d.y, d.z, same);
  if (!(c.rest >= 0.0)) return false;
  roots.nearest = {c.x, c.y, c.z}, roots.direction = d;
  roots.middle = c.middle, roots.half = std::sqrt(c.rest * c.inverse_length2);
  roots.inverse_length2 = c.inverse_length2;
  return true;
}

dvec3 sphere_point(const SphereRoots& r, int side) noexcept {
  const SphereChord<double> c{r.nearest.x,   r.nearest.y, r.nearest.z, r.direction.x,    r.direction.y,
                              r.direction.z, r.middle,    0.0,         r.inverse_length2};
  dvec3 n;
  point_at(c, side < 0 ? -r.half : r.half, n.x, n.y, n.z, same);
  return n;
}

std::optional<PlaceOnSphere> place_on_sphere(const PatchedSphere& sphere, const std::vector<Net>& nets,
                                             const dvec3& n, const Reach& reach) noexcept {
  const CellPlace at = cell_at(n, sphere.patches.cells_a_side);
  const SphereCell& cell = sphere.patches.cells[at.cell];
  if (cell.owner >= 0)
    if (const auto place = in_owned_cell(sphere, cell, at, n)) return place;
  if (cell.others >= 0)
    return among_candidates(sphere, nets, &sphere.patches.candidates[static_cast<std::size_t>(cell.others)],
                            n, reach);
  if (cell.owner < 0) return std::nullopt;
  const SphereCandidate alone[2] = {{cell.owner, cell.u[0], cell.v[0]}, {-1, 0.0f, 0.0f}};
  return among_candidates(sphere, nets, alone, n, reach);
}

bool covers(const PatchedSphere& sphere, const std::vector<Net>& nets, const dvec3& n,
            const Reach& reach) noexcept {
  const CellPlace at = cell_at(n, sphere.patches.cells_a_side);
  const SphereCell& cell = sphere.patches.cells[at.cell];
  return (cell.owner >= 0 && cell.others < 0) || place_on_sphere(sphere, nets, n, reach).has_value();
}

std::vector<PatchedSphere> patched_spheres(const std::vector<Net>& patches, int cells_a_side,
                                           std::vector<bool>& rest) {
  rest.assign(patches.size(), true);
  std::vector<PatchedSphere> out;
  for (const EllipsoidFit& fit : fit_ellipsoids(patches)) {
    PatchedSphere sphere{Ellipsoid(fit.linear), fit.center, 0.0, 0.0, {}};
    if (sphere.ellipsoid.uniform_radius > 0.0) sphere.inverse_radius = 1.0 / sphere.ellipsoid.uniform_radius;
    std::vector<Net> nets;
    std::vector<NetScale> scales;
    for (const std::size_t k : fit.patches) {
      nets.push_back(patches[k]);
      NetScale scale;
      for (dvec4& p : points_of(nets.back())) {
        scale.position = std::max(scale.position, largest(dvec3(p)));
        scale.weight = std::max(scale.weight, p.w);
        p = dvec4(sphere.ellipsoid.inverse * (dvec3(p) - sphere.center * p.w), p.w);
      }
      scales.push_back(scale);
    }
    if (!build_sphere_patches(nets, fit.patches, scales, cells_a_side, sphere.patches)) continue;
    for (const std::size_t k : fit.patches) rest[k] = false;
    sphere.outward = sphere.patches.patches[0].outward;
    for (const SpherePatch& patch : sphere.patches.patches)
      if (patch.outward != sphere.outward) sphere.outward = 0.0;
    out.push_back(std::move(sphere));
  }
  return out;
}

}  // namespace rondure
