#include "renderer/sampling/sampler.h"

#include <boost/random/sobol.hpp>
#include <cmath>
#include <set>
#include <vector>

#include "renderer/sampling/sobol.h"
#include "tests/catch.h"

namespace rondure {
namespace {

TEST_CASE("Sobol' points are Boost's, in the order of the index", "[sampling]") {
  boost::random::sobol_engine<std::uint32_t, 32> engine(sobol_dimensions);
  int failures = 0;
  for (std::uint32_t n = 1; n < 5000; ++n) {  // the engine leaves out point 0 and walks in Gray-code order
    for (int d = 0; d < sobol_dimensions; ++d) failures += engine() != sobol(n ^ (n >> 1), d);
  }
  CHECK(failures == 0);
  // By hand: van der Corput's sequence, and the polynomial x + 1 with all m = 1, 3, 5, ... (Joe and Kuo
  // 2008).
  CHECK(sobol(6, 0) == 0x60000000u);
  CHECK(sobol(2, 1) == 0xc0000000u);
  CHECK(sobol(3, 1) == 0x40000000u);
}

TEST_CASE("Owen scrambling permutes each level of the tree by the bits above it alone", "[sampling]") {
  int failures = 0, flips = 0;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const std::uint32_t x = i * 2654435761u, seed = i * 40503u + 17u;
    const int level = static_cast<int>(i % 31u);
    const std::uint32_t other = x ^ (0x80000000u >> level);  // differs first at `level`, and there alone
    const std::uint32_t a = owen_scramble(x, seed), b = owen_scramble(other, seed);
    failures += __builtin_clz(a ^ b) != level;
    // Where the inputs part, all lower levels are scrambled afresh: the next bit of a and b agrees half of
    // the time.
    flips += ((a ^ b) >> (30 - level) & 1u) != 0;
  }
  CHECK(failures == 0);
  // Binomial with p = 1/2 and n = 20000: deviation 71, five of them allowed.
  CHECK(std::abs(flips - 10000) < 5 * 71);
}

// Points of sample indices [from, from + count), dimensions (2 pair, 2 pair + 1) of a block.
std::vector<dvec2> points(int block, int pair, std::uint32_t from, std::uint32_t count) {
  std::vector<dvec2> result;
  for (std::uint32_t i = from; i < from + count; ++i) {
    Sampler sampler(7, 31, 5, i);
    sampler.start_block(block);
    for (int k = 0; k < pair; ++k) sampler.next_2d();
    result.push_back(sampler.next_2d());
  }
  return result;
}

// Number of cells of a 2^a by 2^b grid that points fall in.
std::size_t cells_met(const std::vector<dvec2>& set, int a, int b) {
  std::set<std::pair<int, int>> cells;
  for (const dvec2& p : set) cells.emplace(int(std::ldexp(p.x, a)), int(std::ldexp(p.y, b)));
  return cells.size();
}

TEST_CASE("aligned runs of 2^k samples are stratified", "[sampling]") {
  int failures = 0;
  for (const int block : {0, 1, 9}) {
    for (const int k : {2, 5, 8}) {
      const std::uint32_t count = 1u << k;
      for (const std::uint32_t from : {0u, count, 5u * count}) {
        // The first two dimensions are a (0, 2)-sequence: one point in every elementary interval of area
        // 2^-k.
        const std::vector<dvec2> first = points(block, 0, from, count);
        for (int a = 0; a <= k; ++a) failures += cells_met(first, a, k - a) != count;
        // Every dimension by itself has one point in each interval of length 2^-k.
        for (int pair = 1; pair < Sampler::block / 2; ++pair) {
          const std::vector<dvec2> set = points(block, pair, from, count);
          failures += cells_met(set, k, 0) != count || cells_met(set, 0, k) != count;
        }
      }
    }
  }
  CHECK(failures == 0);
}

TEST_CASE("a sample depends on seed, pixel, index and dimension, and on nothing else", "[sampling]") {
  Sampler a(1, 2, 3, 4), b(1, 2, 3, 4);
  for (int i = 0; i < 100; ++i) {  // beyond one block: it goes on elsewhere
    const double x = a.next_1d();
    CHECK(x == b.next_1d());
    CHECK((x > 0.0 && x < 1.0));
  }
  // A block's numbers do not depend on what was drawn before it.
  Sampler c(1, 2, 3, 4);
  c.start_block(3);
  a.start_block(3);
  CHECK(a.next_2d() == c.next_2d());

  std::set<double> distinct;
  const auto first = [](std::uint64_t seed, int x, int y, std::uint32_t i) {
    return Sampler(seed, x, y, i).next_1d();
  };
  for (const double x :
       {first(1, 2, 3, 4), first(2, 2, 3, 4), first(1, 3, 3, 4), first(1, 2, 4, 4), first(1, 3, 2, 4),
        first(1, 2, 3, 5), first(1ull << 40, 2, 3, 4), first(1, -2, 3, 4)}) {
    distinct.insert(x);
  }
  CHECK(distinct.size() == 8);
}

TEST_CASE("an overflowing block never draws the numbers of the next", "[sampling]") {
  Sampler over(1, 2, 3, 4), next(1, 2, 3, 4);
  over.start_block(1);
  for (int i = 0; i < Sampler::block; ++i) over.next_1d();
  next.start_block(2);
  CHECK(over.next_1d() != next.next_1d());
}

TEST_CASE("neighbouring pixels and blocks are uncorrelated, and each is uniform", "[sampling]") {
  double mean = 0.0, pixels = 0.0, blocks = 0.0;
  constexpr int n = 40000;
  for (int i = 0; i < n; ++i) {
    Sampler a(3, i % 200, i / 200, 0), b(3, i % 200 + 1, i / 200, 0);
    const double x = a.next_1d() - 0.5, y = b.next_1d() - 0.5;
    a.start_block(1);
    const double z = a.next_1d() - 0.5;
    mean += x;
    pixels += x * y;
    blocks += x * z;
  }
  // Standard deviations of the means: sqrt(1/12) and 1/12 over sqrt(n); five of them.
  CHECK(std::abs(mean / n) < 5.0 * std::sqrt(1.0 / 12.0 / n));
  CHECK(std::abs(pixels / n) < 5.0 / 12.0 / std::sqrt(double(n)));
  CHECK(std::abs(blocks / n) < 5.0 / 12.0 / std::sqrt(double(n)));
}

}  // namespace
}  // namespace rondure
