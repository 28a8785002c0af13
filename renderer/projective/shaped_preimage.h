// Preimages with free numbers: control points that are sums of spinors, each times powers of positive ratios
// and a phase that turns. All patches between the same circular arcs that a construction allows make one such
// family, and share their surface.
#pragma once

#include <array>
#include <cstddef>
#include <variant>
#include <vector>

#include "renderer/projective/preimage.h"
#include "renderer/projective/spinor.h"

namespace rondure {

inline constexpr std::size_t most_ratios = 3, most_turns = 2;

// Values of the free numbers. Those that a family does not have are not looked at.
struct Shape {
  std::array<long double, most_ratios> ratio{1, 1, 1};  // > 0
  std::array<long double, most_turns> turn{0, 0};       // radians
};

// coefficient * product of ratio^power * exp(i sum of turns turn)
struct ShapedTerm {
  Spinor coefficient;
  std::array<double, most_ratios> power{};
  std::array<int, most_turns> turns{};
};

struct ShapedPoint {
  std::vector<ShapedTerm> terms;

  ShapedPoint() = default;
  explicit ShapedPoint(int /* the sum of nothing */) {}
  ShapedPoint(std::initializer_list<ShapedTerm> list) : terms(list) {}
  ShapedPoint& operator*=(double factor) {
    for (ShapedTerm& t : terms) t.coefficient = Complex(factor) * t.coefficient;
    return *this;
  }
};

// What one side's phase changes by from end to end. It must stay within half a turn: there the side passes
// through a base point, and beyond the patch covers more, or less, than what its sides bound.
struct SidePhase {
  long double even;  // where no turn is given
  std::array<int, most_turns> turns{};
};

struct PreimageFamily {
  std::variant<TensorPolynomial<ShapedPoint>, TrianglePolynomial<ShapedPoint>> net;
  std::size_t ratios = 0, turns = 0;
  std::vector<SidePhase> sides;
};

Preimage preimage_at(const PreimageFamily& family, const Shape& shape);

// Whether every side's phase stays within half a turn.
bool within_half_turns(const PreimageFamily& family, const Shape& shape);

}  // namespace rondure
