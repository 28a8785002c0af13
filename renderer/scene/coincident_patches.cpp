#include "renderer/scene/coincident_patches.h"

#include <bit>
#include <cstdint>
#include <unordered_map>

#include "renderer/sampling/hash.h"

namespace rondure {
namespace {

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

// Whether one net is the other, turned or mirrored.
bool are_alike(const TensorNet& a, const TensorNet& b) {
  for (int symmetry = 0; symmetry < 8; ++symmetry) {
    const bool swap = symmetry & 1, back = symmetry & 2, down = symmetry & 4;
    if (a.m != (swap ? b.n : b.m) || a.n != (swap ? b.m : b.n)) continue;
    bool alike = true;
    for (int i = 0; i <= a.m && alike; ++i)
      for (int j = 0; j <= a.n && alike; ++j) {
        const int k = back ? a.m - i : i, l = down ? a.n - j : j;
        alike = a.at(i, j) == (swap ? b.at(l, k) : b.at(k, l));
      }
    if (alike) return true;
  }
  return false;
}

bool are_alike(const TriangleNet& a, const TriangleNet& b) {
  if (a.n != b.n) return false;
  constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
  for (const auto& order : orders) {
    bool alike = true;
    for (int i = 0; i <= a.n && alike; ++i)
      for (int j = 0; i + j <= a.n && alike; ++j) {
        const int index[3] = {i, j, a.n - i - j};
        alike = a.at(i, j) == b.at(index[order[0]], index[order[1]]);
      }
    if (alike) return true;
  }
  return false;
}

bool are_alike(const Net& a, const Net& b) {
  const auto *tensor = std::get_if<TensorNet>(&a), *other = std::get_if<TensorNet>(&b);
  if (tensor && other) return are_alike(*tensor, *other);
  return !tensor && !other && are_alike(std::get<TriangleNet>(a), std::get<TriangleNet>(b));
}

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> coincident_patches(const std::vector<Net>& patches) {
  std::unordered_map<std::uint64_t, std::size_t> marks;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const auto [at, is_new] = marks.try_emplace(mark_of(patches[k]), k);
    if (!is_new && are_alike(patches[at->second], patches[k])) return std::pair{at->second, k};
  }
  return {};
}

}  // namespace rondure
