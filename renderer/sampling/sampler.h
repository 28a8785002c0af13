// The source of every random number: Owen-scrambled Sobol' points.
//
// A number is a function of (seed, pixel, sample index, dimension) and nothing else, so that scheduling never
// reaches the image. Dimensions are taken in blocks: inside a block they are one Sobol' sequence (direction
// numbers of Joe and Kuo 2008, as Boost ships them), scrambled by hashing (Laine and Karras 2011; Burley
// 2020, "Practical hash-based Owen scrambling"); each block meets the pixel's samples in an order of its own,
// itself an Owen scramble of the sample index. Any 2^k samples that start at a multiple of 2^k are thus
// stratified in each block.
#pragma once

#include <cstdint>

#include "renderer/api/patch.h"

namespace rondure {

class Sampler {
 public:
  // Dimensions in a block.
  static constexpr int block = 16;

  Sampler(std::uint64_t seed, int pixel_x, int pixel_y, std::uint32_t index);

  // In (0, 1): odd multiples of 2^-33.
  double next_1d();
  // Two successive dimensions of one block.
  dvec2 next_2d();

  // Go on from the first dimension of block `number`, below 2^20. Integrators give each path vertex a block,
  // so that a vertex that draws less leaves the numbers of the next one alone. A block that runs out is
  // continued in blocks beyond 2^20, never in the next vertex's.
  void start_block(int number);

 private:
  std::uint64_t key_;            // of seed and pixel
  std::uint64_t block_key_ = 0;  // of key and block
  std::uint32_t index_;          // the sample
  std::uint32_t shuffled_ = 0;   // its place in the present block's order
  int block_ = 0;
  int dimension_ = 0;  // inside the block

  double draw();
  void make_room(int count);
};

}  // namespace rondure
