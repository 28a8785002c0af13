#include "renderer/intersect/sphere_patches.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "renderer/bezier/quotient.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/patch_inverse.h"
#include "renderer/intersect/sphere_cells.h"

namespace rondure {
namespace {

// Nets of congruent patches, each in its own frame and with weight 1 in the middle, differ by rounding.
constexpr double congruent = 16.0 * unit_roundoff;

void set_frame(const Net& net, SpherePatch& patch) {
  const double middle = patch.triangle ? 1.0 / 3.0 : 0.5;
  const SurfaceJet jet = surface_jet(net, middle, middle);
  const dvec3 z = -glm::normalize(jet.point);
  dvec3 x = jet.du - glm::dot(jet.du, z) * z;
  if (!(glm::length(x) > 1e-3)) {
    x = dvec3(std::fabs(z.x) < 0.6, std::fabs(z.x) >= 0.6, 0.0);
    x -= glm::dot(x, z) * z;
  }
  x = glm::normalize(x);
  patch.outward = glm::dot(glm::cross(jet.du, jet.dv), jet.point) < 0.0 ? -1.0 : 1.0;
  const dvec3 y = glm::cross(z, x);
  for (int k = 0; k < 3; ++k) patch.axes[k] = dvec4(x[k], y[k], z[k], 0.0);
}

Net in_frame(const Net& net, const SpherePatch& patch) {
  const double middle = patch.triangle ? 1.0 / 3.0 : 0.5;
  const double w = net_first(net, middle, middle).value.w;
  Net out = net;
  for (dvec4& p : points_of(out)) p = dvec4(dvec3(patch.axes * dvec3(p)), p.w) / w;
  return out;
}

bool alike(const Net& a, const Net& b) {
  if (a.index() != b.index()) return false;
  const auto *p = std::get_if<TensorNet>(&a), *q = std::get_if<TensorNet>(&b);
  if (p && (p->m != q->m || p->n != q->n)) return false;
  const auto &x = points_of(a), &y = points_of(b);
  if (x.size() != y.size()) return false;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const dvec4 d = glm::abs(x[k] - y[k]);
    if (!(std::max({d.x, d.y, d.z, d.w}) <= congruent * std::max(1.0, x[k].w))) return false;
  }
  return true;
}

}  // namespace

double invert(const PatchInverse& inverse, const SpherePatch& patch, const dvec3& n, int steps, dvec2& p,
              double enough) {
  const dvec4 local = patch.axes * n;
  const double x = local.x, y = local.y, w = 1.0 - local.z;
  const int k = inverse.degree;
  dvec2 c[25];
  for (int i = 0; i < (k + 1) * (k + 1); ++i) {
    const double* q = &inverse.coefficients[static_cast<std::size_t>(4 * i)];
    c[i] = dvec2((w * q[0] - x * q[2]) + y * q[3], (w * q[1] - x * q[3]) - y * q[2]);
  }
  double moved = INFINITY;
  for (int step = 0; step < steps; ++step) {
    dvec2 f(0.0), fu(0.0), fv(0.0);
    for (int i = k; i >= 0; --i) {
      dvec2 row(0.0), slope(0.0);
      for (int j = k; j >= 0; --j) {
        slope = slope * p.y + row;
        row = row * p.y + c[i * (k + 1) + j];
      }
      fu = fu * p.x + f;
      f = f * p.x + row;
      fv = fv * p.x + slope;
    }
    const double r = quotient(1.0, fu.x * fv.y - fu.y * fv.x);
    const dvec2 move(r * (fv.y * f.x - fv.x * f.y), r * (fu.x * f.y - fu.y * f.x));
    p -= move;
    moved = std::max(std::fabs(move.x), std::fabs(move.y));
    if (!(moved < 4.0)) return INFINITY;
    if (moved < enough) return moved * moved;
  }
  return moved;
}

bool build_sphere_patches(const std::vector<Net>& nets, const std::vector<std::size_t>& which,
                          int cells_a_side, SpherePatches& out) {
  std::vector<Net> known;  // of each inverse
  for (std::size_t k = 0; k < nets.size(); ++k) {
    SpherePatch patch;
    patch.patch = static_cast<std::int32_t>(which[k]);
    patch.triangle = std::holds_alternative<TriangleNet>(nets[k]);
    set_frame(nets[k], patch);
    Net local = in_frame(nets[k], patch);
    std::size_t same = 0;
    while (same < known.size() && !alike(known[same], local)) ++same;
    if (same == known.size()) {
      const auto inverse = patch_inverse(local);
      if (!inverse) return false;
      out.inverses.push_back(*inverse);
      known.push_back(std::move(local));
    }
    patch.inverse = static_cast<std::int32_t>(same);
    out.patches.push_back(patch);
  }
  out.cells_a_side = cells_a_side;
  fill_sphere_cells(nets, out);
  return true;
}

}  // namespace rondure
