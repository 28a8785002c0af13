// Integer hashing for seeds.
#pragma once

#include <cstdint>

namespace rondure {

// A bijection of 64 bits in which every input bit reaches every output bit (the finaliser of SplitMix64;
// Steele, Lea and Flood 2014, with Stafford's constants).
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9u;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebu;
  x ^= x >> 31;
  return x;
}

// Folds one more value into a hash; the golden ratio's bits keep zeros from fixing the state.
constexpr std::uint64_t hash_with(std::uint64_t hash, std::uint64_t value) {
  return mix_bits(hash ^ (mix_bits(value + 0x9e3779b97f4a7c15u) + (hash << 6)));
}

}  // namespace rondure
