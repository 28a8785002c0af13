// Sobol' points and their scrambling, as 32-bit integers (fractions of 2^32).
#pragma once

#include <cstdint>

namespace rondure {

constexpr int sobol_dimensions = 16;

// Coordinate `dimension` of point `index`, in the order of the index's own bits (not Gray-coded).
std::uint32_t sobol(std::uint32_t index, int dimension);

// Owen's nested uniform scrambling with the random tree given by a hash of `seed`: bit k of the result
// depends on bit k and those above it. (Laine and Karras 2011; Burley 2020, section 3; hash constants by
// Vegdahl 2021.)
std::uint32_t owen_scramble(std::uint32_t value, std::uint32_t seed);

}  // namespace rondure
