#include "renderer/shading/ggx.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace rondure {

using std::numbers::pi;

double Ggx::density(const dvec3& h) const {
  if (h.z <= 0.0) return 0.0;
  const double a2 = alpha * alpha;
  // sin^2 / a^2 + cos^2, with the sine from its own components: 1 - cos^2 would cancel where the lobe is
  // narrow.
  const double q = (h.x * h.x + h.y * h.y) / a2 + h.z * h.z;
  return 1.0 / (pi * a2 * q * q);
}

double Ggx::lambda(const dvec3& d) const {
  const double tangent2 = (d.x * d.x + d.y * d.y) / (d.z * d.z);
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * tangent2) - 1.0);
}

double Ggx::masking(const dvec3& d) const { return 1.0 / (1.0 + lambda(d)); }

double Ggx::masking_shadowing(const dvec3& out, const dvec3& in) const {
  return 1.0 / (1.0 + lambda(out) + lambda(in));
}

dvec3 Ggx::sample_visible(const dvec3& out, dvec2 uv) const {
  // Stretched so that the microsurface becomes a hemisphere; reflections off it fill a spherical cap
  // uniformly.
  const dvec3 stretched = glm::normalize(dvec3(alpha * out.x, alpha * out.y, out.z));
  const double z = (1.0 - uv.y) * (1.0 + stretched.z) - stretched.z;
  const double r = std::sqrt(std::clamp(1.0 - z * z, 0.0, 1.0));
  const double angle = 2.0 * pi * uv.x;
  const dvec3 half = dvec3(r * std::cos(angle), r * std::sin(angle), z) + stretched;
  return glm::normalize(dvec3(alpha * half.x, alpha * half.y, std::max(half.z, 0.0)));
}

}  // namespace rondure
