#include "renderer/sampling/sobol.h"

#include <array>
#include <boost/random/sobol.hpp>

namespace rondure {
namespace {

using Directions = std::array<std::array<std::uint32_t, 32>, sobol_dimensions>;

// Boost keeps its direction numbers to itself, but its points show them: point n is the sum (mod 2) of the
// numbers at the bits of the Gray code n ^ n/2, and the Gray code of 2^(k+1) - 1 is the single bit k.
Directions read_directions() {
  Directions directions{};
  for (int k = 0; k < 32; ++k) {
    // A seed of n makes the next point drawn number n + 1, for the engine leaves out point 0.
    const std::uint32_t before = (k == 31 ? 0xffffffffu : (2u << k) - 1u) - 1u;
    boost::random::sobol_engine<std::uint32_t, 32> engine(sobol_dimensions);
    engine.seed(before);
    for (int d = 0; d < sobol_dimensions; ++d) {
      directions[static_cast<std::size_t>(d)][static_cast<std::size_t>(k)] = engine();
    }
  }
  return directions;
}

std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  x = ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
  return x;
}

}  // namespace

std::uint32_t sobol(std::uint32_t index, int dimension) {
  static const Directions directions = read_directions();
  const auto& column = directions[static_cast<std::size_t>(dimension)];
  std::uint32_t x = 0;
  for (std::size_t k = 0; index != 0; index >>= 1, ++k) {
    x ^= column[k] & (0u - (index & 1u));
  }
  return x;
}

std::uint32_t owen_scramble(std::uint32_t value, std::uint32_t seed) {
  // On reversed bits each step lets low bits act on higher ones only: addition does, multiplication by odd
  // numbers, and the addition (mod 2) of even multiples.
  std::uint32_t x = reverse_bits(value);
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reverse_bits(x);
}

}  // namespace rondure
