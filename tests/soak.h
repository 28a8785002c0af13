// How long tests last that may last longer: `tests/run --soak` sets RONDURE_SOAK to 1, unless it names a
// part. RONDURE_SEED names other rays and paths than those of a usual run.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace rondure {

// 0 of a default run, 1 of a whole soak.
inline double soak_part() {
  const char* const part = std::getenv("RONDURE_SOAK");
  return part ? std::clamp(std::atof(part), 0.0, 1.0) : 0.0;
}

// `usual` rays, paths or places by default, in a soak the part of `whole` that is asked for, but never fewer.
inline double soaked(double usual, double whole) { return std::max(usual, soak_part() * whole); }

// Where the seeds begin of a test that counts its random rays or paths in millions: at 1, or in another
// thousand.
inline std::uint64_t first_seed() {
  const char* const number = std::getenv("RONDURE_SEED");
  return 1 + 1000 * (number ? std::strtoull(number, nullptr, 10) : 0);
}

}  // namespace rondure
