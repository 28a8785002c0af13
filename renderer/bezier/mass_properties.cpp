#include "renderer/bezier/mass_properties.h"

#include <algorithm>
#include <boost/math/special_functions/ellint_rg.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "renderer/bezier/epsilon.h"
#include "renderer/bezier/patch_integrals.h"
#include "renderer/bezier/rational.h"
#include "renderer/parallel/parallel_for.h"

namespace rondure {
namespace {

constexpr double error_goal = 1e-13;
constexpr std::size_t most_cells = 100000, most_cells_of_a_patch = 4000;

dmat3 inertia_of(const dmat3& second) { return dmat3(second[0][0] + second[1][1] + second[2][2]) - second; }

// A point near the middle of the surface, and how far it reaches from there: a choice of units, no bound.
struct Frame {
  dvec3 middle{0.0};
  double extent = 0.0;
};

Frame frame_of(const Surface& surface) {
  dvec3 low(infinity), high(-infinity);
  const auto each = [&](auto use) {
    for (const Net& net : surface.patches) {
      const bool triangle = std::holds_alternative<TriangleNet>(net);
      for (const double u : {0.0, 0.5, 1.0}) {
        for (const double v : {0.0, 0.5, 1.0}) {
          if (triangle && u + v > 1.0) continue;
          const dvec3 p = net_point(net, u, v);
          if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) use(p);
        }
      }
    }
  };
  each([&](const dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); });
  Frame frame;
  if (!(low.x <= high.x)) return frame;
  frame.extent = 0.5 * glm::length(high - low);
  // Moving the origin rounds the control points: it is left alone where it is near enough.
  const dvec3 middle = 0.5 * (low + high);
  if (glm::length(middle) > 0.5 * frame.extent) frame.middle = middle;
  each([&](const dvec3& p) { frame.extent = std::max(frame.extent, glm::length(p - frame.middle)); });
  return frame;
}

struct BodySum {
  MomentSums sums;
  OrderErrors errors{};

  void add(const MomentSums& s, const OrderErrors& e) {
    sums.total += s.total;
    sums.first += s.first;
    for (std::size_t k = 0; k < s.second.size(); ++k) sums.second[k] += s.second[k];
    for (std::size_t k = 0; k < 3; ++k) errors[k] += e[k];
  }
};

// With m = first / total: centroid m, second moment about it S - total m m^T.
Body body_of(const BodySum& sum, const dvec3& about) {
  const MomentSums& s = sum.sums;
  Body out;
  out.measure = static_cast<double>(s.total);
  out.measure_error = sum.errors[0] + epsilon * std::abs(out.measure);
  out.centroid_error = out.inertia_error = infinity;
  const double size = static_cast<double>(std::abs(s.total)), least = size - sum.errors[0];
  if (!(least > 0.0)) return out;
  const lvec3 centre = s.first / s.total;
  const double far = static_cast<double>(glm::length(centre));
  out.centroid = about + dvec3(centre);
  out.centroid_error = (sum.errors[1] + far * sum.errors[0]) / least +
                       2.0 * epsilon * (glm::length(about) + glm::length(out.centroid));
  dmat3 second;
  std::size_t k = 0;
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b) {
      second[a][b] = second[b][a] = static_cast<double>(s.second[k++] - s.total * centre[a] * centre[b]);
    }
  }
  // A solid that is inside out has the same inertia.
  out.inertia = inertia_of(s.total < 0.0L ? -second : second);
  const double first = static_cast<double>(glm::length(s.first));
  const double product = (2.0 * first * sum.errors[1] + sum.errors[1] * sum.errors[1]) / least +
                         first * first * sum.errors[0] / (size * least);
  double largest = 0.0;
  for (int a = 0; a < 3; ++a) largest = std::max(largest, out.inertia[a][a]);
  // A diagonal element sums two moments.
  out.inertia_error = 2.0 * (sum.errors[2] + product) + 4.0 * epsilon * largest;
  return out;
}

MassProperties of_patches(const Surface& surface) {
  const std::size_t count = surface.patches.size();
  const Frame frame = frame_of(surface);
  IntegralGoal each;
  each.error = error_goal / static_cast<double>(std::max<std::size_t>(count, 1));
  each.extent = frame.extent > 0.0 ? frame.extent : 1.0;
  each.most_cells = static_cast<int>(
      std::clamp<std::size_t>(most_cells / std::max<std::size_t>(count, 1), 1, most_cells_of_a_patch));
  std::vector<PatchIntegrals> parts(count);
  parallel_for(count,
               [&](std::size_t k) { parts[k] = integrate_patch(surface.patches[k], frame.middle, each); });
  BodySum shell, solid;
  lvec3 vector_area(0.0L);
  for (const PatchIntegrals& p : parts) {
    shell.add(p.area, p.area_error);
    solid.add(p.cone, p.cone_error);
    vector_area += p.vector_area;
  }
  MassProperties out;
  out.shell = body_of(shell, frame.middle);
  if (!surface.closed) return out;
  // Control points that are rounded leave gaps of that size; what is open is open by more.
  const double gap = static_cast<double>(glm::length(vector_area));
  out.leaks = gap > 1e-9 * out.shell.measure + 4.0 * shell.errors[0];
  if (!out.leaks) out.solid = body_of(solid, frame.middle);
  return out;
}

// The lengths of the semi-axes: Jacobi's rotations of the columns, which lose nothing on the short ones.
dvec3 semi_axes(dmat3 m) {
  for (int sweep = 0; sweep < 12; ++sweep) {
    for (int a = 0; a < 2; ++a) {
      for (int b = a + 1; b < 3; ++b) {
        const double aa = glm::dot(m[a], m[a]), bb = glm::dot(m[b], m[b]), ab = glm::dot(m[a], m[b]);
        if (std::abs(ab) <= 0.25 * epsilon * std::sqrt(aa * bb)) continue;
        const double zeta = (bb - aa) / (2.0 * ab);
        const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::sqrt(1.0 + zeta * zeta));
        const double c = 1.0 / std::sqrt(1.0 + t * t), s = c * t;
        const dvec3 old = m[a];
        m[a] = c * old - s * m[b];
        m[b] = s * old + c * m[b];
      }
    }
  }
  return {glm::length(m[0]), glm::length(m[1]), glm::length(m[2])};
}

MassProperties of_ellipsoid(const dmat3& map) {
  constexpr double pi = std::numbers::pi;
  // Of a chain of some tens of operations, each well conditioned.
  constexpr double rounding = 64.0 * epsilon;
  const dvec3 axes = semi_axes(map);
  const double product = axes.x * axes.y * axes.z;
  MassProperties out;
  // 4 pi a b c R_G(a^-2, b^-2, c^-2) (Carlson 1995), homogeneous of degree 1/2.
  const double longest = std::max({axes.x, axes.y, axes.z});
  const dvec3 inverse = longest / axes;
  const double mean =
      boost::math::ellint_rg(inverse.x * inverse.x, inverse.y * inverse.y, inverse.z * inverse.z);
  out.shell.measure = 4.0 * pi * product / longest * mean;
  out.shell.measure_error = rounding * out.shell.measure;
  out.shell.inertia_error = infinity;
  const bool sphere = std::min({axes.x, axes.y, axes.z}) >= (1.0 - 16.0 * epsilon) * longest;
  if (sphere) {
    out.shell.inertia = dmat3(2.0 / 3.0 * out.shell.measure * longest * longest);
    out.shell.inertia_error = rounding * out.shell.inertia[0][0];
  }
  Body solid;
  solid.measure = 4.0 / 3.0 * pi * product;
  solid.measure_error = rounding * solid.measure;
  solid.inertia = inertia_of(solid.measure / 5.0 * (map * glm::transpose(map)));
  solid.inertia_error = rounding * solid.measure * longest * longest;
  out.solid = solid;
  return out;
}

}  // namespace

MassProperties mass_properties(const Surface& surface) {
  return surface.ellipsoid ? of_ellipsoid(*surface.ellipsoid) : of_patches(surface);
}

}  // namespace rondure
