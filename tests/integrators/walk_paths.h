// Many paths over all threads, and how many there are to be.
#pragma once

#include <algorithm>
#include <cstdint>

#include "tests/soak.h"
#include "tests/tallied.h"

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
  return tallied<Tally>((paths + grain - 1) / grain, [&](std::size_t part, Tally& tally) {
    const auto first = static_cast<std::uint32_t>(part) * grain, end = std::min(first + grain, paths);
    for (std::uint32_t k = first; k < end; ++k) walk.walk(seed, k, tally);
  });
}

}  // namespace rondure
