#include "renderer/sampling/sampler.h"

#include "renderer/sampling/hash.h"
#include "renderer/sampling/sobol.h"

namespace rondure {

static_assert(Sampler::block <= sobol_dimensions);

Sampler::Sampler(std::uint64_t seed, int pixel_x, int pixel_y, std::uint32_t index)
    : key_(hash_with(hash_with(hash_with(0, seed), static_cast<std::uint32_t>(pixel_x)),
                     static_cast<std::uint32_t>(pixel_y))),
      index_(index) {
  start_block(0);
}

void Sampler::start_block(int number) {
  block_ = number;
  dimension_ = 0;
  block_key_ = hash_with(key_, static_cast<std::uint64_t>(number));
  shuffled_ = owen_scramble(index_, static_cast<std::uint32_t>(block_key_));
}

double Sampler::draw() {
  const std::uint64_t seed = mix_bits(block_key_ + static_cast<std::uint64_t>(dimension_ + 1));
  const std::uint32_t x = owen_scramble(sobol(shuffled_, dimension_), static_cast<std::uint32_t>(seed));
  ++dimension_;
  return (static_cast<double>(x) + 0.5) * 0x1p-32;
}

void Sampler::make_room(int count) {
  constexpr int overflow = 1 << 20;
  if (dimension_ + count > block) start_block(block_ + overflow);
}

double Sampler::next_1d() {
  make_room(1);
  return draw();
}

dvec2 Sampler::next_2d() {
  make_room(2);
  // Two statements: the order in which arguments are evaluated is open.
  const double x = draw();
  const double y = draw();
  return {x, y};
}

}  // namespace rondure
