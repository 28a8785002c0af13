// Linear algebra over the integers modulo a prime: what is independent there is so over the rationals, and
// for nearly no system is it the other way round.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "renderer/complex/spline_conditions.h"

namespace rondure {

// (place, value), in order of the places, no value 0.
using ModularRow = std::vector<std::pair<int, std::uint64_t>>;

// A multiple of the row, its unknowns at places[unknown]; those with a negative place are left out.
ModularRow modular_row(const SparseRow& row, const std::vector<int>& places);

// Rows in echelon form, which grow.
class ModularEchelon {
 public:
  explicit ModularEchelon(std::size_t places) : pivots_(places) {}

  // Whether the row is independent of those added before; then it is added. Its pivot is the first place of
  // what is left of it.
  bool add(ModularRow row);
  std::size_t rank() const { return rank_; }
  bool is_pivot(std::size_t place) const { return !pivots_[place].empty(); }

 private:
  std::vector<ModularRow> pivots_;  // by first place, with the value 1 there
  std::size_t rank_ = 0;
};

}  // namespace rondure
