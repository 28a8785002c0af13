// Walks into singular points: what the estimators and the solvers make of ever smaller distances.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "renderer/normals/normal_field.h"
#include "renderer/study/ray_trials.h"
#include "renderer/study/singular_sites.h"

namespace rondure {

inline constexpr std::size_t estimator_count = 7;

// One place on a walk. Angles in radians; NaN where there is no normal to compare with, or none given.
struct WalkStep {
  std::size_t site = 0;   // index of the singular point
  double way = 0.0;       // direction of the walk in the parameters, degrees from the u axis
  double distance = 0.0;  // from the singular point, in the parameters
  dvec2 at{0.0};
  double sine = 0.0, condition = 0.0, smallest = 0.0;  // |Su x Sv| / (|Su| |Sv|); of the Jacobian (Su Sv)
  std::string reference;                        // "analytic" where the patch lies on a quadric, else "limit"
  std::array<double, estimator_count> error{};  // angle to the reference, by estimator
  std::array<double, estimator_count>
      radiance{};  // |difference| of max(0, n . l), l at 60 degrees to the reference
  std::array<RayTrial, RayTrials::solver_count> trials;
};

struct WalkOptions {
  int ways = 3;        // directions into a site
  int per_decade = 2;  // places
  int decades = 14;    // from 10^-1
};

// What the other normals at a site are compared with: the gradient of the quadric that the patch lies on; the
// limit where there is no quadric, and beside a quadric's own singular point, a cone's tip, where the
// gradient vanishes and rounding of the point turns it.
NormalEstimator reference_at(const NormalField& field, const SingularSite& site);

// All walks into one site. The field and the trials are of the same surface.
std::vector<WalkStep> walk(const Surface& surface, const NormalField& field, const RayTrials& trials,
                           const SingularSite& site, std::size_t index, const WalkOptions& options);

// The slope of log(error) over log(distance), by least squares over the places whose error lies between 10
// times 2^-52 and 0.1; empty where there are fewer than four.
struct Slope {
  double value = 0.0;
  double low = 0.0, high = 0.0;  // distances
  int places = 0;
};
std::optional<Slope> fitted_slope(const std::vector<double>& distances, const std::vector<double>& errors);

}  // namespace rondure
