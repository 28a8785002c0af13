// Many paths over all threads, and how many there are to be.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <cstdint>

#include "tests/soak.h"

namespace rondure {

// `usual` paths, a twentieth of them under the sanitizers; in a soak 10^8.
inline double wanted_paths(double usual) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  usual *= 0.05;
#endif
  return soaked(usual, 1e8);
}

// walk.walk(seed, k, tally) for every k below `paths`, in parts of `grain`; the tallies merged.
template <class Tally, class Walk>
Tally walk_paths(const Walk& walk, std::uint64_t seed, std::uint32_t paths, std::uint32_t grain) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::uint32_t>(0, paths, grain), Tally{},
      [&](const tbb::blocked_range<std::uint32_t>& range, Tally part) {
        for (std::uint32_t k = range.begin(); k < range.end(); ++k) walk.walk(seed, k, part);
        return part;
      },
      [](Tally a, const Tally& b) { return a.merge(b), a; });
}

}  // namespace rondure
