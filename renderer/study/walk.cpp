#include "renderer/study/walk.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "renderer/bezier/angle.h"
#include "renderer/bezier/rational.h"
#include "renderer/sampling/warps.h"

namespace rondure {
namespace {

using std::numbers::pi;
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

bool inside(const Net& net, dvec2 p) {
  if (p.x < 0.0 || p.y < 0.0) return false;
  return std::holds_alternative<TensorNet>(net) ? p.x <= 1.0 && p.y <= 1.0 : p.x + p.y <= 1.0;
}

// Ways that lead inside, spread over the angle in which they do.
std::vector<dvec2> ways_in(const Net& net, const SingularSite& site, int count) {
  std::vector<double> angles;
  const double about = std::atan2(site.inward.y, site.inward.x);
  constexpr int fine = 720;
  for (int k = -fine / 2; k < fine / 2; ++k) {
    const double angle = about + (k + 0.5) * 2.0 * pi / fine;
    if (inside(net, site.at + 0.1 * dvec2(std::cos(angle), std::sin(angle)))) angles.push_back(angle);
  }
  std::vector<dvec2> ways;
  for (int k = 0; k < count && !angles.empty(); ++k) {
    const auto place = static_cast<std::size_t>((k + 0.5) / count * static_cast<double>(angles.size()));
    ways.push_back({std::cos(angles[place]), std::sin(angles[place])});
  }
  return ways;
}

void measure_jacobian(const Net& net, WalkStep& step) {
  const SurfaceJet s = surface_jet(net, step.at.x, step.at.y);
  const double e = glm::dot(s.du, s.du), f = glm::dot(s.du, s.dv), g = glm::dot(s.dv, s.dv);
  const double area = glm::length(glm::cross(s.du, s.dv));
  const double largest = std::sqrt(0.5 * (e + g + std::hypot(e - g, 2.0 * f)));
  step.sine = e > 0.0 && g > 0.0 ? area / std::sqrt(e) / std::sqrt(g) : 0.0;
  step.smallest = largest > 0.0 ? area / largest : 0.0;
  step.condition = step.smallest > 0.0 ? largest / step.smallest : std::numeric_limits<double>::infinity();
}

void measure_normals(const NormalField& field, const SingularSite& site, const dvec3& reference,
                     WalkStep& step) {
  // Light at 60 degrees, where its share changes fast with the normal.
  const dvec3 aside = frame_about(reference).x;
  const dvec3 light = 0.5 * reference + std::sqrt(0.75) * aside;
  for (std::size_t k = 0; k < estimator_count; ++k) {
    const NormalEstimate n = field.at(static_cast<NormalEstimator>(k), site.patch, step.at.x, step.at.y);
    step.error[k] = n ? angle_between(*n, reference) : missing;
    // What has no normal scatters no light.
    step.radiance[k] = std::abs((n ? std::max(0.0, glm::dot(*n, light)) : 0.0) - 0.5);
  }
}

}  // namespace

NormalEstimator reference_at(const NormalField& field, const SingularSite& site) {
  const PatchQuadric* q = field.quadric(site.patch);
  if (!q) return NormalEstimator::limit;
  // A length of the fit's scale away the gradient has its usual size.
  const double here = glm::length(q->quadric.gradient(site.point));
  const double usual = glm::length(q->quadric.gradient(site.point + dvec3(0.5, 0.4, 0.3) * q->quadric.scale));
  return here > 1e-3 * usual ? NormalEstimator::analytic : NormalEstimator::limit;
}

std::vector<WalkStep> walk(const Surface& surface, const NormalField& field, const RayTrials& trials,
                           const SingularSite& site, std::size_t index, const WalkOptions& options) {
  const Net& net = surface.patches[static_cast<std::size_t>(site.patch)];
  const NormalEstimator exact = reference_at(field, site);
  std::vector<WalkStep> steps;
  for (const dvec2& way : ways_in(net, site, options.ways)) {
    for (int k = 0; k <= (options.decades - 1) * options.per_decade; ++k) {
      WalkStep step;
      step.site = index;
      step.way = std::atan2(way.y, way.x) * 180.0 / pi;
      step.distance = std::pow(10.0, -1.0 - static_cast<double>(k) / options.per_decade);
      step.at = site.at + step.distance * way;
      if (!inside(net, step.at)) continue;  // by rounding
      // As far as the parameters hold it.
      step.distance = glm::distance(step.at, site.at);
      if (!(step.distance > 0.0)) continue;
      measure_jacobian(net, step);
      step.reference = estimator_names()[static_cast<std::size_t>(exact)];
      const NormalEstimate reference = field.at(exact, site.patch, step.at.x, step.at.y);
      if (!reference) continue;
      measure_normals(field, site, *reference, step);
      step.trials = trials.at(net_point(net, step.at.x, step.at.y), *reference);
      steps.push_back(std::move(step));
    }
  }
  return steps;
}

std::optional<Slope> fitted_slope(const std::vector<double>& distances, const std::vector<double>& errors) {
  constexpr double least = 10.0 * std::numeric_limits<double>::epsilon(), most = 0.1;
  Slope slope;
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < distances.size(); ++k) {
    if (!(errors[k] > least && errors[k] < most)) continue;
    const double x = std::log10(distances[k]), y = std::log10(errors[k]);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
    slope.low = slope.places == 0 ? distances[k] : std::min(slope.low, distances[k]);
    slope.high = std::max(slope.high, distances[k]);
    ++slope.places;
  }
  const double n = slope.places, spread = n * sxx - sx * sx;
  if (slope.places < 4 || !(spread > 0.0)) return {};
  slope.value = (n * sxy - sx * sy) / spread;
  return slope;
}

}  // namespace rondure
