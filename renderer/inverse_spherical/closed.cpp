#include "renderer/inverse_spherical/closed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace rondure {
namespace {

// A side as a rational curve, run through with the patch on its left as seen from outside.
struct Side {
  std::vector<dvec4> points;
  double key = 0.0;  // the same from both ends, and from both patches up to rounding

  dvec3 at(double t) const {
    std::vector<dvec4> work = points;
    for (std::size_t left = work.size() - 1; left > 0; --left) {
      for (std::size_t k = 0; k < left; ++k) work[k] = (1.0 - t) * work[k] + t * work[k + 1];
    }
    return dvec3(work[0]) / work[0].w;
  }
};

std::array<Side, 3> sides_of(const TriangleNet& net) {
  std::array<Side, 3> sides;
  for (int k = 0; k <= net.n; ++k) {
    sides[0].points.push_back(net.at(net.n - k, k));
    sides[1].points.push_back(net.at(0, net.n - k));
    sides[2].points.push_back(net.at(k, 0));
  }
  return sides;
}

bool opposite(const Side& a, const Side& b, double tolerance) {
  const std::size_t count = a.points.size() + b.points.size() - 1;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(count - 1);
    if (!(glm::distance(a.at(t), b.at(1.0 - t)) <= tolerance)) return false;
  }
  return true;
}

}  // namespace

bool closes_up(const std::vector<TriangleNet>& patches) {
  std::vector<Side> sides;
  double size = 0.0;
  // A direction with nothing in common with the vertices of any model, to sort by.
  const dvec3 along(0.53770812, 0.30195523, 0.78723041);
  for (const TriangleNet& net : patches) {
    for (Side& side : sides_of(net)) {
      const dvec3 sum = side.at(0.0) + side.at(1.0);
      side.key = glm::dot(sum, along);
      size = std::max(size, glm::length(sum));
      sides.push_back(std::move(side));
    }
  }
  const double tolerance = 64.0 * std::numeric_limits<double>::epsilon() * size;
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.key < b.key; });
  std::vector<bool> paired(sides.size(), false);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (paired[k]) continue;
    for (std::size_t m = k + 1; m < sides.size() && sides[m].key - sides[k].key <= 4.0 * tolerance; ++m) {
      if (paired[m] || !opposite(sides[k], sides[m], tolerance)) continue;
      paired[k] = paired[m] = true;
      break;
    }
    if (!paired[k]) return false;
  }
  return !sides.empty();
}

}  // namespace rondure
