#include "renderer/complex/modular.h"

#include <algorithm>

namespace rondure {
namespace {

constexpr std::uint64_t prime = 2147483647;  // 2^31 - 1: products fit into 64 bits

std::uint64_t inverse(std::uint64_t x) {
  std::uint64_t result = 1;
  for (std::uint64_t power = prime - 2; power > 0; power /= 2, x = x * x % prime) {
    if (power % 2 == 1) result = result * x % prime;
  }
  return result;
}

void scale(ModularRow& row, std::uint64_t factor) {
  for (auto& entry : row) entry.second = entry.second * factor % prime;
}

// row + factor pivot, whose first places cancel.
ModularRow combined(const ModularRow& row, const ModularRow& pivot, std::uint64_t factor) {
  ModularRow out;
  out.reserve(row.size() + pivot.size());
  auto r = row.begin() + 1;
  auto p = pivot.begin() + 1;
  while (r != row.end() || p != pivot.end()) {
    if (p == pivot.end() || (r != row.end() && r->first < p->first)) {
      out.push_back(*r++);
      continue;
    }
    std::uint64_t value = factor * p->second % prime;
    const int place = p->first;
    if (r != row.end() && r->first == place) value = (value + (r++)->second) % prime;
    ++p;
    if (value != 0) out.emplace_back(place, value);
  }
  return out;
}

}  // namespace

ModularRow modular_row(const SparseRow& row, const std::vector<int>& places) {
  Integer common = 1;
  for (const auto& entry : row) common = lcm(common, Integer(denominator(entry.second)));
  ModularRow out;
  for (const auto& [unknown, c] : row) {
    const int place = places[static_cast<std::size_t>(unknown)];
    if (place < 0) continue;
    Integer rest = Integer(numerator(c)) * (common / Integer(denominator(c))) % prime;
    if (rest < 0) rest += prime;
    if (rest != 0) out.emplace_back(place, static_cast<std::uint64_t>(rest));
  }
  std::sort(out.begin(), out.end());
  return out;
}

bool ModularEchelon::add(ModularRow row) {
  while (!row.empty()) {
    ModularRow& pivot = pivots_[static_cast<std::size_t>(row.front().first)];
    if (pivot.empty()) {
      scale(row, inverse(row.front().second));
      pivot = std::move(row);
      ++rank_;
      return true;
    }
    row = combined(row, pivot, prime - row.front().second);
  }
  return false;
}

}  // namespace rondure
