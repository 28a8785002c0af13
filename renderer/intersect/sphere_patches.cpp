#include "renderer/intersect/sphere_patches.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/bezier/quotient.h"
#include "renderer/bezier/rational.h"
#include "renderer/intersect/patch_inverse.h"
#include "renderer/intersect/sphere_cells.h"

namespace rondure {
namespace {

// By how much coordinates of congruent patches' nets may differ, each in its own frame and with weight 1 in
// the middle, in units of what rounding makes of them.
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

// What patch k of a sphere's is, in its frame.
const std::vector<dvec4>& known_of(const SpherePatches& patches, const std::vector<Net>& known,
                                   std::size_t k) {
  return points_of(known[static_cast<std::size_t>(patches.patches[k].inverse)]);
}

double weight_of(const std::vector<dvec4>& points) {
  double sum = 0.0;
  for (const dvec4& p : points) sum += p.w;
  return sum;
}

bool alike(const dvec4& p, const dvec4& q, double rounding) {
  const dvec4 d = glm::abs(p - q);
  return std::max({d.x, d.y, d.z, d.w}) <= congruent * rounding * std::max(1.0, p.w);
}
bool alike(const Net& a, const Net& b, double rounding) {
  const auto &x = points_of(a), &y = points_of(b);
  return same_degrees(a, b) && std::equal(x.begin(), x.end(), y.begin(), [&](const dvec4& p, const dvec4& q) {
           return alike(p, q, rounding);
         });
}

// Whether the known nets are these, turned.
bool are_alike(const SpherePatches& patches, const std::vector<Net>& known, const std::vector<Net>& nets,
               const dmat3& turn, double rounding) {
  for (std::size_t k = 0; k < nets.size(); ++k) {
    const std::vector<dvec4>&x = known_of(patches, known, k), &y = points_of(nets[k]);
    const dmat3 to_frame = dmat3(patches.patches[k].axes) * turn;
    const double scale = weight_of(x) / weight_of(y);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!alike(x[i], scale * dvec4(to_frame * dvec3(y[i]), y[i].w), rounding)) return false;
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

bool build_sphere_patches(const std::vector<Net>& nets, double rounding, int cells_a_side, SpherePatches& out,
                          std::vector<Net>& known) {
  for (std::size_t k = 0; k < nets.size(); ++k) {
    SpherePatch patch;
    patch.triangle = std::holds_alternative<TriangleNet>(nets[k]);
    set_frame(nets[k], patch);
    Net local = in_frame(nets[k], patch);
    std::size_t same = 0;
    while (same < known.size() && !alike(known[same], local, rounding)) ++same;
    if (same == known.size()) {
      const auto inverse = patch_inverse(local, rounding);
      if (!inverse) return false;
      out.inverses.push_back(*inverse);
      known.push_back(std::move(local));
    }
    patch.inverse = static_cast<std::int32_t>(same);
    out.patches.push_back(patch);
    out.one_kind = out.one_kind && patch.triangle == out.patches[0].triangle;
  }
  for (std::size_t p = 0; p < std::min(nets.size(), SpherePatches::few); ++p)
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        out.axes_of_few[static_cast<std::size_t>(3 * i + k)][p] = out.patches[p].axes[i][k];
  out.cells_a_side = cells_a_side;
  fill_sphere_cells(nets, out);
  return true;
}

std::optional<dmat3> turn_onto(const SpherePatches& patches, const std::vector<Net>& known,
                               const std::vector<Net>& nets, double rounding) {
  if (nets.size() != patches.patches.size()) return std::nullopt;
  for (std::size_t k = 0; k < nets.size(); ++k)
    if (!same_degrees(known[static_cast<std::size_t>(patches.patches[k].inverse)], nets[k]))
      return std::nullopt;
  if (are_alike(patches, known, nets, dmat3(1.0), rounding)) return dmat3(1.0);
  // The nearest rotation, in the sense of least squares: the orthogonal factor of the points' products.
  dmat3 turn(0.0);
  for (std::size_t k = 0; k < nets.size(); ++k) {
    const std::vector<dvec4>&x = known_of(patches, known, k), &y = points_of(nets[k]);
    dmat3 sum(0.0);
    for (std::size_t i = 0; i < x.size(); ++i) sum += glm::outerProduct(dvec3(x[i]), dvec3(y[i]));
    turn += (1.0 / weight_of(y)) * (glm::transpose(dmat3(patches.patches[k].axes)) * sum);
  }
  // Higham 1986: Newton's iteration, scaled.
  const auto size2 = [](const dmat3& m) {
    return glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]);
  };
  if (!(glm::determinant(turn) > 0.0)) return std::nullopt;
  for (int k = 0; k < 12; ++k) {
    const dmat3 other = glm::transpose(glm::inverse(turn));
    const double scale = std::sqrt(std::sqrt(size2(other) / size2(turn)));
    const dmat3 next = (0.5 * scale) * turn + (0.5 / scale) * other;
    const double moved = size2(next - turn);
    turn = next;
    if (moved < 1e-20) break;
  }
  if (!are_alike(patches, known, nets, turn, rounding)) return std::nullopt;
  return turn;
}

}  // namespace rondure
