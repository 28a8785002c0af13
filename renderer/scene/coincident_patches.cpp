#include "renderer/scene/coincident_patches.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <unordered_map>

#include "renderer/bezier/rational.h"
#include "renderer/sampling/hash.h"

namespace rondure {
namespace {

bool comes_before(const dvec4& a, const dvec4& b) {
  for (int k = 0; k < 4; ++k)
    if (a[k] != b[k]) return a[k] < b[k];
  return false;
}

std::vector<dvec4> sorted_points(const Net& net) {
  std::vector<dvec4> points = points_of(net);
  std::sort(points.begin(), points.end(), comes_before);
  return points;
}

// The same for every order of the points.
std::uint64_t mark_of(const Net& net) {
  std::uint64_t sum = 0;
  for (const dvec4& p : points_of(net)) {
    std::uint64_t mark = 0;
    for (int k = 0; k < 4; ++k) mark = hash_with(mark, std::bit_cast<std::uint64_t>(p[k] + 0.0));  // -0 is 0
    sum += mark;
  }
  return sum;
}

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> coincident_patches(const std::vector<Net>& patches) {
  std::unordered_map<std::uint64_t, std::size_t> marks;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const auto [at, is_new] = marks.try_emplace(mark_of(patches[k]), k);
    if (!is_new && sorted_points(patches[at->second]) == sorted_points(patches[k]))
      return std::pair{at->second, k};
  }
  return {};
}

}  // namespace rondure
