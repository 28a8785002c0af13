#include <algorithm>

#include "renderer/api/params.h"

namespace rondure {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Insertions, deletions, substitutions and swaps of neighbours, each counted once, blind to case.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> older, old(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) old[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({old[j] + 1, row[j - 1] + 1, old[j - 1] + (same ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], older[j - 2] + 1);
    }
    older = std::move(old);
    old = row;
  }
  return old[b.size()];
}

}  // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = std::string::npos;
  for (const std::string& candidate : candidates) {
    std::size_t d = distance(word, candidate);
    // One in three letters may be wrong, and a beginning or an end alone counts as one slip.
    const bool part = candidate.starts_with(word) || candidate.ends_with(word);
    if (word.size() >= 3 && part) d = std::min<std::size_t>(d, 1);
    const std::size_t limit = std::max<std::size_t>(1, std::max(word.size(), candidate.size()) / 3);
    if (d > limit || d >= std::max(word.size(), candidate.size()) || d >= least) continue;
    least = d;
    best = candidate;
  }
  return best;
}

}  // namespace rondure
