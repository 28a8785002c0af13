// How many cells one query's searches may take.
#pragma once

#include <algorithm>
#include <vector>

#include "renderer/intersect/clipping.h"

namespace rondure {

// A net on which a ray takes more cells than any regular one needs is degenerate: it must neither stop the
// program nor keep the ray from what else it meets. So each surface has so many of its own.
class SearchBudget {
 public:
  static constexpr std::size_t cells_per_surface = 1 << 16;  // 31,000 are the most seen at a singular corner

  // For the next query.
  void start() { taken_.clear(); }

  // Has `search()`, which counts in `counts`, take no more than what is left to the surface.
  template <class Search>
  void spend(unsigned surface, SearchCounts& counts, const Search& search) {
    // Most likely the last that was searched.
    auto taken =
        std::find_if(taken_.rbegin(), taken_.rend(), [&](const Taken& t) { return t.surface == surface; });
    if (taken == taken_.rend()) taken_.push_back({surface, 0}), taken = taken_.rbegin();
    const std::size_t before = counts.cells;
    counts.limit = before + (cells_per_surface - std::min(taken->cells, cells_per_surface));
    search();
    taken->cells += counts.cells - before;
    counts.limit = SearchCounts{}.limit;
  }

 private:
  struct Taken {
    unsigned surface;
    std::size_t cells;
  };
  std::vector<Taken> taken_;  // few: of surfaces that were searched
};

}  // namespace rondure
