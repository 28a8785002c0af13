#include "renderer/projective/shared_points.h"

#include <algorithm>
#include <glm/common.hpp>

namespace rondure {
namespace {

double largest(const dvec4& p) {
  const dvec4 a = glm::abs(p);
  return std::max(std::max(a.x, a.y), std::max(a.z, a.w));
}

}  // namespace

void share_control_points(std::vector<Net>& patches) {
  std::vector<dvec4> known;
  for (Net& patch : patches) {
    auto& net = std::get<TensorNet>(patch);
    for (int i = 0; i <= net.m; ++i) {
      for (int j = 0; j <= net.n; ++j) {
        if (i > 0 && i < net.m && j > 0 && j < net.n) continue;
        dvec4& p = net.at(i, j);
        const double reach = 0x1p-51 * largest(p);
        const auto same =
            std::find_if(known.begin(), known.end(), [&](const dvec4& q) { return largest(p - q) <= reach; });
        if (same != known.end())
          p = *same;
        else
          known.push_back(p);
      }
    }
  }
}

}  // namespace rondure
