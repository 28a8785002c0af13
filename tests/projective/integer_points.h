// Points of projective 3-space with small integer coordinates, on which polynomial identities of low degree
// hold exactly in extended precision.
#pragma once

#include <random>

#include "renderer/projective/generalised_projection.h"

namespace rondure {

class IntegerPoints {
 public:
  explicit IntegerPoints(unsigned seed) : engine_(seed) {}

  long double number(int limit) {
    const auto values = static_cast<std::uint64_t>(2 * limit + 1);
    return static_cast<long double>(engine_() % values) - static_cast<long double>(limit);
  }
  lvec4 point(int limit = 9) {
    lvec4 p(0);
    while (p == lvec4(0)) {
      for (int k = 0; k < 4; ++k) p[k] = number(limit);
    }
    return p;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace rondure
